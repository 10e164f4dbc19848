// AMD FidelityFX Denoiser 1.3 (reflections), third pass, laid out as the original: history is clipped to the colours
// around the pixel and accumulated.
#include "amd_sssr/denoiser_average_lookup.glsl"
#include "amd_sssr/denoiser_clip.glsl"
#include "amd_sssr/denoiser_resolve_inputs.glsl"
#include "amd_sssr/denoiser_shared_halves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D radiance, variance;

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = tile_start(group_index()) + local;
    for (int i = 0; i < 4; ++i) {
        ivec2 block = ivec2(i & 1, i >> 1) * 8;
        share_color(local + block, neighbor_color(filtered_color(pixel - reach + block)));
    }
    barrier();
    float alpha = texel(roughness, pixel).r;
    if (!is_in_image(pixel) || is_final(alpha)) return;
    vec3 present = shared_color_at(local + reach).rgb;
    vec4 result = vec4(present, texelFetch(prefiltered_variance, pixel, 0).r);
    if (!no_dark_exit && present.r + present.g + present.b < dark_exit_radiance) {
        result = vec4(0.0);
    } else if (is_glossy(alpha)) {
        float samples = texelFetch(sample_count, pixel, 0).r;
        vec3 history = texelFetch(reprojected_radiance, pixel, 0).rgb;
        result = accumulate(present, result.w, history, samples, average_around(pixel),
                            neighborhood_at(local + reach));
    }
    imageStore(radiance, pixel, vec4(result.rgb, 0.0));
    imageStore(variance, pixel, vec4(result.w));
}
