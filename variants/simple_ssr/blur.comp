// One axis of the mean over a square. Only the roughness of the pixel in the middle decides the square's size.
#include "common/mirror_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { uint axis; };
uniform sampler2D sharp;
uniform writeonly image2D result;

const int most_pixels = 32;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 mean = vec4(0.0);
    if (reflects(pixel, max_roughness)) {
        float width = blur_width * camera.extent.y * texelFetch(normal, pixel, 0).w;
        int reach = min(int(round(width)), most_pixels);
        vec4 sum = vec4(0.0);  // of confidence: radiance, 1
        float count = 0.0;
        for (int i = -reach; i <= reach; ++i) {
            ivec2 neighbor = pixel + (axis == 0u ? ivec2(i, 0) : ivec2(0, i));
            if (!is_on_screen(neighbor) || !reflects(neighbor, max_roughness)) continue;
            vec4 found = texelFetch(sharp, neighbor, 0);
            sum += vec4(found.rgb * found.a, found.a);
            count += 1.0;
        }
        if (sum.a > 0.0) mean = vec4(sum.rgb / sum.a, sum.a / count);
    }
    imageStore(result, pixel, mean);
}
