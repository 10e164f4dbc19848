// Traces the test's own rays, each from the surface of a pixel.
#define COUNT_DEPTH_FETCHES
#include "tracer"

layout(local_size_x = 64) in;
uniform sampler2D ray_start;      // pixel
uniform sampler2D ray_direction;  // view space, unit; random number
uniform writeonly image2D end_place;    // un-jittered screen (pixels), distance (m), confidence
uniform writeonly image2D end_meeting;  // pixel, outcome, depth fetches

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(ray_start, 0).x) return;
    ivec2 pixel = ivec2(texelFetch(ray_start, index, 0).xy);
    vec4 direction = texelFetch(ray_direction, index, 0);
    depth_fetches = 0u;
    TraceEnd end = trace(TraceRay(pixel, 0u, view_position(pixel), direction.xyz, view_geometric_normal(pixel),
                                  direction.w, true));
    imageStore(end_place, index, vec4(end.position, end.distance, end.confidence));
    imageStore(end_meeting, index, vec4(vec2(end.pixel), float(end.outcome), float(depth_fetches)));
}
