// First half of the guided filter (He et al. 2010, "Guided Image Filtering", eq. 5 and 6): over the window about each pixel
// the line in the distance from the camera plane that fits the colours best.
#include "diligent_ssr/cleanup.glsl"

layout(location = 0) out vec4 guided_slope;   // per metre
layout(location = 1) out vec4 guided_offset;  // at the pixel's own distance

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float variance = texelFetch(accumulated_variance, pixel, 0).r;
    int radius = kernel_radius(pixel, variance, kernel_sigma(variance));
    float pixel_depth = camera_depth_at(pixel), count = 0.0, guide = 0.0, squares = 0.0;
    vec4 colors = vec4(0.0), products = vec4(0.0);
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            ivec2 neighbor = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(camera.extent.xy) - 1);
            if (!is_kept(neighbor)) continue;
            float nearer = camera_depth_at(neighbor) - pixel_depth;
            vec4 color = texelFetch(accumulated_radiance, neighbor, 0);
            count += 1.0;
            guide += nearer;
            squares += nearer * nearer;
            colors += color;
            products += nearer * color;
        }
    count = max(count, 1.0);
    guide /= count;
    colors /= count;
    float smallest = guided_epsilon * pixel_depth;
    guided_slope = (products / count - guide * colors) / (max(squares / count - guide * guide, 0.0) + smallest * smallest);
    guided_offset = colors - guided_slope * guide;
}
