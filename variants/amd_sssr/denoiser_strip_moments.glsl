// The 9x9 moments in the fast form.
#ifndef AMD_SSSR_DENOISER_STRIP_MOMENTS_GLSL
#define AMD_SSSR_DENOISER_STRIP_MOMENTS_GLSL
#include "amd_sssr/denoiser_moments.glsl"
#include "amd_sssr/denoiser_strip.glsl"

// Colour of a pixel inside of the image, and whether it counts: defined by the pass.
vec4 strip_neighbor(ivec2 pixel);

// Moments of all pixels of the strip, as neighborhood_at() has them: the weights are products, so that each row is
// summed once for all pixels below and above it. Pixels outside of the image count as black.
Neighborhood[8] strip_neighborhoods(ivec2 first) {
    float kernel[9], inside[9];
    int columns[9];
    float kernel_sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        int x = first.x + i - reach;
        columns[i] = clamp(x, 0, last_pixel().x);
        kernel[i] = kernel_weight(i - reach);
        inside[i] = x == columns[i] ? kernel[i] : 0.0;
        kernel_sum += kernel[i];
    }
    Moments rows[16];
    for (int j = 0; j < 16; ++j) {
        Moments row = no_moments;
        int y = clamp(first.y + j - reach, 0, last_pixel().y);
        for (int i = 0; i < 9; ++i) {
            vec4 color = strip_neighbor(ivec2(columns[i], y));
            vec3 weighted = inside[i] * color.rgb;
            row.color += weighted;
            row.square += weighted * color.rgb;
            row.weight += kernel[i] * color.w;
        }
        float is_inside = y == first.y + j - reach ? 1.0 : 0.0;
        rows[j] = Moments(is_inside * row.color, is_inside * row.square, row.weight);
    }
    Neighborhood result[8];
    for (int y = 0; y < 8; ++y) {
        Moments sum = no_moments;
        for (int j = 0; j < 9; ++j) {
            sum.color += kernel[j] * rows[y + j].color;
            sum.square += kernel[j] * rows[y + j].square;
            sum.weight += kernel[j] * rows[y + j].weight;
        }
        if (!finite_neighborhood) sum.weight = kernel_sum * kernel_sum;
        result[y] = neighborhood_of(sum);
    }
    return result;
}
#endif
