// The temporal resolve, with the same output as resolve_temporal.comp, from strips of pixels.
#include "amd_sssr/denoiser_average_lookup.glsl"
#include "amd_sssr/denoiser_resolve.glsl"
#include "amd_sssr/denoiser_strip_moments.glsl"

vec4 strip_neighbor(ivec2 pixel) { return counted(filtered_color(pixel)); }

void main() {
    ivec2 first = strip_start();
    Neighborhood around[8] = strip_neighborhoods(first);
    for (int y = 0; y < 8; ++y) {
        ivec2 pixel = first + ivec2(0, y);
        if (is_on_screen(pixel)) resolve(pixel, strip_neighbor(pixel).rgb, around[y]);
    }
}
