// Marches the test's own rays through the depth image; found: place on the screen (pixels), distance (m), 1 if it hit.
#include "tracers/dda/dda.glsl"

layout(local_size_x = 64) in;
uniform sampler2D ray_origin, ray_direction;
uniform writeonly image2D found;

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(ray_origin, 0).x) return;
    // No pixel's own rays: what the tracer makes of pixel and normal, the checkerboard alone, is left out.
    TraceEnd end = dda_trace(TraceRay(ivec2(0), 0u, texelFetch(ray_origin, index, 0).xyz,
                                      texelFetch(ray_direction, index, 0).xyz, vec3(0.0), 0.0, true));
    bool is_hit = end.outcome == outcome_hit;
    imageStore(found, index, is_hit ? vec4(end.position, end.distance, 1.0) : vec4(0.0));
}
