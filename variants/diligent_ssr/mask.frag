// Keeps the pixels that reflect and are smooth enough, and extracts their roughness.
#include "common/mirror_ray.glsl"
#include "common/image_space.glsl"
layout(location = 0) out float roughness;

// The original reads roughness from a buffer of 8 bits. Codes become numbers here as on the device that the original
// was recorded on, by a multiplication after which 51/255 exceeds a threshold of 0.2: a division would round to 0.2.
float buffered(float perceptual) {
    return float_roughness ? perceptual : floor(perceptual * 255.0 + 0.5) * (1.0 / 255.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float stored = buffered(texelFetch(normal, pixel, 0).w);
    roughness = roughness_perceptual ? stored : sqrt(stored);
    bool is_reflective = !is_far_plane(texelFetch(depth, pixel, 0).r) && has_specular(pixel);
    if (!is_reflective || roughness > roughness_threshold) discard;
    gl_FragDepth = 1.0;  // what is kept in a mask by depth
}
