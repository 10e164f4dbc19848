// Marches the test's own rays. ray_start: pixel; ray_direction: view space, w random number. found: pixel, distance (m),
// 1 if it hit.
#include "frostbite_sssr/march_hierarchy.glsl"
#include "frostbite_sssr/march_linear.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Tracer { uint is_linear; };
uniform sampler2D ray_start, ray_direction;
uniform writeonly image2D found;

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(ray_start, 0).x) return;
    ivec2 pixel = ivec2(texelFetch(ray_start, index, 0).xy);
    vec4 direction = texelFetch(ray_direction, index, 0);
    ScreenLine line = screen_line(pixel, view_position(pixel), direction.xyz, view_geometric_normal(pixel));
    March end = is_linear == 1u ? march_linear(line, direction.w) : march_hierarchy(line);
    imageStore(found, index, vec4(end.pixel, distance_at(line, end.t), end.is_hit));
}
