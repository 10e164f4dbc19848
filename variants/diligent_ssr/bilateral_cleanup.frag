// Last pass of DiligentFX's denoising: where the variance is high, an average over neighbours of the same surface,
// with the edge-stopping functions of Schied et al. 2017 ("Spatiotemporal Variance-Guided Filtering", section 4.4).
#include "core/shaders/view.glsl"
#include "common/image_space.glsl"
#include "core/shaders/view.glsl"
#include "diligent_ssr/half.glsl"

layout(location = 0) out vec4 reflections;

uniform sampler2D depth, normal, roughness, accumulated_radiance, accumulated_variance;

const float noisy_variance = 1e-3;
const float widest_radius = 2.0;  // pixels
const float normal_exponent = 128.0;

float camera_depth_at(ivec2 pixel) { return camera_depth(texelFetch(depth, pixel, 0).r); }

// Pixels; mirrors need none.
int kernel_radius(ivec2 pixel) {
    bool is_noisy = texelFetch(accumulated_variance, pixel, 0).r > noisy_variance;
    float radius = is_noisy ? widest_radius * clamp(8.0 * texelFetch(roughness, pixel, 0).r, 0.0, 1.0) : 0.0;
    return int(min(2.0 * bilateral_cleanup_spatial_sigma_factor, radius));
}

bool is_kept(ivec2 pixel) {
    return texelFetch(roughness, pixel, 0).r <= roughness_threshold && !is_far_plane(texelFetch(depth, pixel, 0).r);
}

// `ws_normal`, `pixel_depth`: of the pixel. `depth_change`: of the camera depth over the offset, if the surface is flat (m).
float edge_stop(vec3 ws_normal, float pixel_depth, ivec2 neighbor, float depth_change) {
    float same_normal = pow(max(dot(ws_normal, texelFetch(normal, neighbor, 0).xyz), 0.0), normal_exponent);
    float difference = abs(pixel_depth - camera_depth_at(neighbor));
    return same_normal * exp(-difference / (abs(depth_change) + 1e-6));
}

vec4 filtered(ivec2 pixel, float pixel_depth, int radius, vec2 depth_gradient) {
    vec3 ws_normal = texelFetch(normal, pixel, 0).xyz;
    float sigma = bilateral_cleanup_spatial_sigma_factor, weight_sum = 0.0;
    vec4 sum = vec4(0.0);
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            ivec2 neighbor = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(camera.extent.xy) - 1);
            if (!is_kept(neighbor)) continue;
            vec2 offset = vec2(float(x), float(y));
            float weight = exp(-dot(offset, offset) / (2.0 * sigma * sigma)) *
                           edge_stop(ws_normal, pixel_depth, neighbor, dot(offset, depth_gradient));
            sum += weight * texelFetch(accumulated_radiance, neighbor, 0);
            weight_sum += weight;
        }
    return sum / max(weight_sum, 1e-6);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float pixel_depth = camera_depth_at(pixel);
    vec2 depth_gradient = vec2(dFdx(pixel_depth), dFdy(pixel_depth));
    int radius = bilateral_cleanup ? kernel_radius(pixel) : 0;
    vec4 radiance = radius > 0 ? filtered(pixel, pixel_depth, radius, depth_gradient) : texelFetch(accumulated_radiance, pixel, 0);
    if (premultiply_confidence) radiance.rgb = radiance.a > 0.0 ? radiance.rgb / radiance.a : vec3(0.0);
    reflections = vec4(radiance.rgb, radiance.a * alpha_interpolation);
    if (!float_histories) reflections = as_halves(reflections);  // rgb / a may exceed what a half holds
}
