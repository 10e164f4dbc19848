// AMD FidelityFX Denoiser 1.3 (reflections), third pass, laid out as the original: history is clipped to the colours
// around the pixel and accumulated.
#include "amd_sssr/denoiser_resolve.glsl"
#include "amd_sssr/denoiser_shared_halves.glsl"
#include "neighborhood"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = tile_start(group_index()) + local;
    for (int i = 0; i < 4; ++i) {
        ivec2 block = ivec2(i & 1, i >> 1) * 8, neighbor = pixel - reach + block;
        share_color(local + block, is_on_screen(neighbor) ? counted(filtered_color(neighbor)) : outside_color);
    }
    barrier();
    if (is_on_screen(pixel)) resolve(pixel, shared_color_at(local + reach).rgb, neighborhood_at(local + reach));
}
