// Reflectance of a pixel's dielectric part at normal incidence, which the specular factor scales: GBuffer::dielectric_f0.
#ifndef GBUFFER_DIELECTRIC_F0_GLSL
#define GBUFFER_DIELECTRIC_F0_GLSL
uniform sampler2D dielectric_f0;

// Reflectance of a pixel's dielectric part at normal incidence, before the specular factor.
vec3 dielectric_f0_at(ivec2 pixel) {
    return texelFetch(dielectric_f0, min(pixel, textureSize(dielectric_f0, 0) - 1), 0).rgb;
}
#endif
