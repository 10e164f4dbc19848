// The inputs of AMD's denoiser for each glossy pixel: what its ray saw, with the fallback for the unknown part, and the
// ray's length. Rays that hit nothing reach to the far plane, as with far_misses; with misses = weight, rays that are
// known to bring no light have no length.
#include "amd_sssr/lists.glsl"
#include "core/shaders/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D own_radiance, own_length, roughness, fallback;
uniform writeonly image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel) || !is_glossy(texelFetch(roughness, pixel, 0).r)) return;
    vec4 own = texelFetch(own_radiance, pixel, 0);
    float ray_length = texelFetch(own_length, pixel, 0).r;
    vec3 seen = mix(ibl_factor * texelFetch(fallback, pixel, 0).rgb, own.rgb, own.a);
    const bool misses_are_unknown = misses == 0u;
    bool is_miss = ray_length == 0.0 && !(misses_are_unknown && own.a > 0.0);
    imageStore(radiance, pixel, vec4(seen, is_miss ? camera.depth.y : ray_length));
}
