// Marches the test's own rays. ray_start: pixel; ray_direction: view space, w random number. found: pixel, distance (m),
// 1 if it hit.
#include "tracers/frostbite/hierarchical.glsl"
#include "tracers/frostbite/linear.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Tracer { uint is_linear; };
uniform sampler2D ray_start, ray_direction;
uniform writeonly image2D found;

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(ray_start, 0).x) return;
    ivec2 pixel = ivec2(texelFetch(ray_start, index, 0).xy);
    vec4 direction = texelFetch(ray_direction, index, 0);
    TraceRay ray = TraceRay(pixel, 0u, view_position(pixel), direction.xyz, view_geometric_normal(pixel),
                            direction.w, false);
    TraceEnd end = is_linear == 1u ? frostbite_linear_trace(ray) : frostbite_hierarchical_trace(ray);
    bool is_hit = end.outcome == outcome_hit;
    imageStore(found, index, is_hit ? vec4(end.pixel, end.distance, 1.0) : vec4(0.0));
}
