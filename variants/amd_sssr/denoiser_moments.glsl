// Weighted mean and variance of the 9x9 pixels around each pixel.
#ifndef AMD_SSSR_DENOISER_MOMENTS_GLSL
#define AMD_SSSR_DENOISER_MOMENTS_GLSL

struct Neighborhood {
    vec3 mean, variance;
};

// The weight of a neighbour is the product of these along x and y.
float kernel_weight(int distance) { return exp(-gaussian_k * float(distance * distance) / 25.0); }

Neighborhood neighborhood_of(vec3 sum, vec3 sum_of_squares, float sum_of_weights) {
    vec3 mean = sum / sum_of_weights;
    return Neighborhood(mean, abs(sum_of_squares / sum_of_weights - mean * mean));
}
#endif
