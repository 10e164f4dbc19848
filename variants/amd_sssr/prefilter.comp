// AMD FidelityFX Denoiser 1.3 (reflections), second pass, laid out as the original: an edge-stopping filter over 15
// neighbours, the stronger the more the pixel has changed over time.
#include "amd_sssr/denoiser_prefilter.glsl"
#include "amd_sssr/denoiser_shared_halves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
shared uvec2 shared_normal[16][16];  // xyz, variance
shared float shared_depth[16][16];   // m

void share_neighbor(ivec2 pixel, ivec2 at) {
    share_color(at, counted(texel(radiance, pixel).rgb));
    shared_normal[at.y][at.x] =
        packed_halves(vec4(unit_or_zero(texel(normal, pixel).xyz), texel(variance, pixel).r));
    shared_depth[at.y][at.x] = -view_z(texel(depth, pixel).r);
}

Neighbor neighbor_at(ivec2 at) {
    vec4 normal_and_variance = unpacked_halves(shared_normal[at.y][at.x]), color = shared_color_at(at);
    return Neighbor(color.rgb, color.w, normal_and_variance.xyz, normal_and_variance.w, shared_depth[at.y][at.x]);
}

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = tile_start(group_index()) + local;
    for (int i = 0; i < 4; ++i) {
        ivec2 block = ivec2(i & 1, i >> 1) * 8;
        share_neighbor(pixel - reach + block, local + block);
    }
    barrier();
    if (!is_on_screen(pixel)) return;
    Filter filtered = start_filter(neighbor_at(local + reach), average_around(pixel));
    for (int i = 0; i < 15; ++i) add_tap(filtered, neighbor_at(local + reach + filter_taps[i]));
    store_filtered(pixel, filtered);
}
