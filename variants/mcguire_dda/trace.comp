// hit: uv (un-jittered screen) of the point that each pixel's mirror ray meets, its distance (m), 1 if it meets any.
#include "mcguire_dda/dda.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D hit;

float start_of(ivec2 pixel) { return checkerboard && ((pixel.x + pixel.y) & 1) == 1 ? jitter + 0.5 : jitter; }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 result = vec4(0.0);
    if (reflects(pixel, max_roughness)) {
        Ray ray = mirror_ray(pixel);
        if (trace_inward_rays || dot(ray.direction, view_geometric_normal(pixel)) > 0.0) {
            DdaHit found = march(ray, start_of(pixel));
            if (found.is_hit) result = vec4(found.position * camera.extent.zw, found.distance, 1.0);
        }
    }
    imageStore(hit, pixel, result);
}
