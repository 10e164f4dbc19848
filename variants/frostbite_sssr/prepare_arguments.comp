// Numbers of groups for the two tracers.
#include "common/indirect_groups.glsl"
#include "frostbite_sssr/counters.glsl"

layout(local_size_x = 1) in;
buffer indirect_arguments { uint hierarchical_groups[3], linear_groups[3]; };

void main() {
    hierarchical_groups = spread((hierarchical_count + 63u) / 64u);
    linear_groups = spread((linear_count + 63u) / 64u);
}
