// Shared by the two filters of the last pass: their reach, their input, and the use of their result.
#ifndef DILIGENT_SSR_CLEANUP_GLSL
#define DILIGENT_SSR_CLEANUP_GLSL
#include "common/image_space.glsl"
#include "common/half.glsl"

uniform sampler2D depth, normal, roughness, accumulated_radiance, accumulated_variance;

const float noisy_variance = 1e-3;
const float widest_radius = 2.0;  // pixels

float camera_depth_at(ivec2 pixel) { return camera_depth(texelFetch(depth, pixel, 0).r); }

// Pixels.
float kernel_sigma(float variance) {
    float deviation = sqrt(max(variance, 0.0));
    float share = sigma_from_variance ? deviation / (deviation + 0.1) : 1.0;
    return bilateral_cleanup_spatial_sigma_factor * share;
}

// Pixels; mirrors need none.
int kernel_radius(ivec2 pixel, float variance, float sigma) {
    bool is_noisy = sigma_from_variance || variance > noisy_variance;
    float radius = is_noisy ? widest_radius * clamp(8.0 * texelFetch(roughness, pixel, 0).r, 0.0, 1.0) : 0.0;
    return int(min(2.0 * sigma, radius));
}

bool is_kept(ivec2 pixel) {
    return texelFetch(roughness, pixel, 0).r <= roughness_threshold && !is_far_plane(texelFetch(depth, pixel, 0).r);
}

vec4 finished(vec4 radiance) {
    if (premultiply_confidence) radiance.rgb = radiance.a > 0.0 ? radiance.rgb / radiance.a : vec3(0.0);
    vec4 result = vec4(radiance.rgb, radiance.a * alpha_interpolation);
    return float_histories ? result : as_halves(result);  // rgb / a may exceed what a half holds
}
#endif
