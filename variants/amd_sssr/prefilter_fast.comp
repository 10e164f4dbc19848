// The prefilter, with the same output as prefilter.comp, from strips of pixels. Normals and variances are shared, since
// converting them to halves costs more than sharing. All else is fetched once for all pixels of a strip that look at
// the same neighbour. With float_histories there is no conversion, and nothing is shared.
#extension GL_EXT_control_flow_attributes : require
#include "amd_sssr/denoiser_prefilter.glsl"
#include "amd_sssr/denoiser_strip.glsl"

const int tap_reach = 3, side = 8 + 2 * tap_reach;
shared uvec2 shared_normal[8][side * side];  // tile, pixel; xyz and variance

// Unit normal and variance. A pixel outside of the image has no normal, and so no weight.
vec4 normal_and_variance_of(ivec2 pixel) {
    ivec2 at = clamp(pixel, ivec2(0), last_pixel());
    vec3 ws_normal = at == pixel ? unit_or_zero(texelFetch(normal, at, 0).xyz) : vec3(0.0);
    return vec4(ws_normal, texelFetch(variance, at, 0).r);
}

void share_normals(ivec2 start) {
    int index = int(gl_LocalInvocationID.x);
    do {
        ivec2 pixel = start - tap_reach + ivec2(index % side, index / side);
        shared_normal[gl_LocalInvocationID.y][index] = packed_halves(normal_and_variance_of(pixel));
        index += 8;
    } while (index < side * side);
}

// `offset`: from the strip's first pixel.
Neighbor neighbor_at(ivec2 first, ivec2 offset) {
    ivec2 at = clamp(first + offset, ivec2(0), last_pixel());
    int index = (offset.y + tap_reach) * side + offset.x + tap_reach + int(gl_LocalInvocationID.x);
    vec4 color = counted(texelFetch(radiance, at, 0).rgb);
    vec4 normal_and_variance = float_histories ? normal_and_variance_of(first + offset)
                                               : unpacked_halves(shared_normal[gl_LocalInvocationID.y][index]);
    return Neighbor(color.rgb, color.w, normal_and_variance.xyz, normal_and_variance.w,
                    -view_z(texelFetch(depth, at, 0).r));
}

void main() {
    ivec2 first = strip_start();
    if (!float_histories) {
        share_normals(first - ivec2(gl_LocalInvocationID.x, 0));
        barrier();
    }
    Filter filters[8];
    [[unroll]] for (int y = 0; y < 8; ++y)
        filters[y] = start_filter(neighbor_at(first, ivec2(0, y)), average_around(first + ivec2(0, y)));
    [[unroll]] for (int tap = 0; tap < 15; ++tap)
        [[unroll]] for (int y = 0; y < 8; ++y)
            add_tap(filters[y], neighbor_at(first, filter_taps[tap] + ivec2(0, y)));
    [[unroll]] for (int y = 0; y < 8; ++y) {
        ivec2 pixel = first + ivec2(0, y);
        if (is_on_screen(pixel)) store_filtered(pixel, filters[y]);
    }
}
