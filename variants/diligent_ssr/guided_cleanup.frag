// Second half of the guided filter (He et al. 2010, eq. 8): the mean over the lines of all windows that hold the pixel.
#include "diligent_ssr/cleanup.glsl"

layout(location = 0) out vec4 reflections;
uniform sampler2D guided_slope, guided_offset;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float variance = texelFetch(accumulated_variance, pixel, 0).r, pixel_depth = camera_depth_at(pixel), count = 0.0;
    int radius = kernel_radius(pixel, variance, kernel_sigma(variance));
    vec4 sum = vec4(0.0);
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            ivec2 neighbor = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(camera.extent.xy) - 1);
            if (!is_kept(neighbor)) continue;
            float nearer = pixel_depth - camera_depth_at(neighbor);
            sum += texelFetch(guided_slope, neighbor, 0) * nearer + texelFetch(guided_offset, neighbor, 0);
            count += 1.0;
        }
    // Lines leave the range of what they fit.
    reflections = finished(radius == 0 ? texelFetch(accumulated_radiance, pixel, 0) : max(sum / max(count, 1.0), vec4(0.0)));
}
