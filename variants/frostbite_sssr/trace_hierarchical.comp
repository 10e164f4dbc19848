// Traces the listed rays of smooth surfaces.
#include "frostbite_sssr/counters.glsl"
#include "frostbite_sssr/march_hierarchy.glsl"
#include "frostbite_sssr/trace_ray.glsl"

layout(local_size_x = 64) in;
buffer hierarchical_list { uint listed_ray[]; };

March march(ScreenLine line, float random) { return march_hierarchy(line); }

void main() {
    uint place = place_in_list();
    if (place >= hierarchical_count) return;
    uint index = listed_ray[place];
    store_ray(index, trace_ray(traced_pixel(traced_of_ray(index), camera.frame.x), index % max_rays, ray_dimension));
}
