// Traces the listed rays of rough surfaces.
#include "frostbite_sssr/counters.glsl"
#include "frostbite_sssr/march_linear.glsl"
#include "frostbite_sssr/trace_listed.glsl"

layout(local_size_x = 64) in;
buffer linear_list { uint listed_ray[]; };

March march(ScreenLine line, float random) { return march_linear(line, random); }

void main() {
    uint place = place_in_list();
    if (place >= linear_count) return;
    trace_listed(listed_ray[place]);
}
