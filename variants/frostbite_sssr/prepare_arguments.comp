// Writes the numbers of groups for the two tracers.
#include "common/indirect_groups.glsl"
#include "frostbite_sssr/counters.glsl"

layout(local_size_x = 1) in;
buffer indirect_arguments { uint smooth_groups[3], rough_groups[3]; };

void main() {
    smooth_groups = spread((smooth_count + 63u) / 64u);
    rough_groups = spread((rough_count + 63u) / 64u);
}
