// Traces the listed rays of smooth surfaces.
#include "frostbite_sssr/counters.glsl"
#include "frostbite_sssr/march_hierarchy.glsl"
#include "frostbite_sssr/trace_listed.glsl"

layout(local_size_x = 64) in;
buffer hierarchical_list { uint listed_ray[]; };

March march(ScreenLine line, float random) { return march_hierarchy(line); }

void main() {
    uint place = place_in_list();
    if (place >= hierarchical_count) return;
    trace_listed(listed_ray[place]);
}
