// Last pass of DiligentFX's denoising: where the variance is high, an average over neighbours of the same surface,
// with the edge-stopping functions of Schied et al. 2017 ("Spatiotemporal Variance-Guided Filtering", section 4.4).
#include "diligent_ssr/cleanup.glsl"

layout(location = 0) out vec4 reflections;

const float normal_exponent = 128.0;

// `ws_normal`, `pixel_depth`: of the pixel. `depth_change`: of the camera depth over the offset, if the surface is flat (m).
float edge_stop(vec3 ws_normal, float pixel_depth, ivec2 neighbor, float depth_change) {
    float same_normal = pow(max(dot(ws_normal, texelFetch(normal, neighbor, 0).xyz), 0.0), normal_exponent);
    float difference = abs(pixel_depth - camera_depth_at(neighbor));
    return same_normal * exp(-difference / (abs(depth_change) + 1e-6));
}

vec4 filtered(ivec2 pixel, float pixel_depth, int radius, float sigma, vec2 depth_gradient) {
    vec3 ws_normal = texelFetch(normal, pixel, 0).xyz;
    float weight_sum = 0.0;
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
    float variance = texelFetch(accumulated_variance, pixel, 0).r, sigma = kernel_sigma(variance);
    int radius = bilateral_cleanup ? kernel_radius(pixel, variance, sigma) : 0;
    vec4 radiance = radius > 0 ? filtered(pixel, pixel_depth, radius, sigma, depth_gradient) : texelFetch(accumulated_radiance, pixel, 0);
    reflections = finished(radiance);
}
