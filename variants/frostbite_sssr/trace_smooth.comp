// Traces the listed rays of smooth surfaces.
#include "tracer"
#include "frostbite_sssr/counters.glsl"
#include "frostbite_sssr/trace_listed.glsl"

layout(local_size_x = 64) in;
buffer smooth_list { uint listed_ray[]; };

TraceEnd march(TraceRay ray) { return smooth_trace(ray); }

void main() {
    uint place = place_in_list();
    if (place >= smooth_count) return;
    trace_listed(listed_ray[place]);
}
