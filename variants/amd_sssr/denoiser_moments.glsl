// Weighted mean and variance of the 9x9 pixels around each pixel.
#ifndef AMD_SSSR_DENOISER_MOMENTS_GLSL
#define AMD_SSSR_DENOISER_MOMENTS_GLSL
#include "amd_sssr/denoiser_tile.glsl"

struct Neighborhood {
    vec3 mean, variance;
};

// A colour, and in w whether it counts: with finite_neighborhood one that is not finite does not.
vec4 counted(vec3 color) {
    if (!finite_neighborhood) return vec4(color, 1.0);
    return is_finite(color) ? vec4(min(color, largest_half), 1.0) : vec4(0.0);
}

const vec4 outside_color = vec4(0.0, 0.0, 0.0, 1.0);  // of pixels outside of the image: they count as black

// The weight of a neighbour is the product of these along x and y.
float kernel_weight(int distance) { return exp(-gaussian_k * float(distance * distance) / 25.0); }

// Weighted sums over neighbours.
struct Moments {
    vec3 color, square;
    float weight;
};

const Moments no_moments = Moments(vec3(0.0), vec3(0.0), 0.0);

// `color`: w as counted() has it.
void add_neighbor(vec4 color, float weight, inout Moments sum) {
    if (finite_neighborhood) weight *= color.w;
    sum.weight += weight;
    sum.color += weight * color.rgb;
    sum.square += weight * color.rgb * color.rgb;
}

Neighborhood neighborhood_of(Moments sum) {
    vec3 mean = sum.color / sum.weight;
    return Neighborhood(mean, abs(sum.square / sum.weight - mean * mean));
}
#endif
