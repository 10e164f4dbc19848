// Traces the listed rays of rough surfaces.
#include "rough_tracer"
#include "frostbite_sssr/counters.glsl"
#include "frostbite_sssr/trace_listed.glsl"

layout(local_size_x = 64) in;
buffer rough_list { uint listed_ray[]; };

TraceEnd march(TraceRay ray) { return rough_trace(ray); }

void main() {
    uint place = place_in_list();
    if (place >= rough_count) return;
    trace_listed(listed_ray[place]);
}
