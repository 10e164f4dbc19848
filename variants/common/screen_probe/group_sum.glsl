// Sums of `group_terms` vectors over a workgroup of 64 invocations. Whoever includes this defines their number first.
#ifndef SCREEN_PROBE_GROUP_SUM_GLSL
#define SCREEN_PROBE_GROUP_SUM_GLSL

shared vec4 group_values[64][group_terms];

// Call it once, from all invocations.
vec4[group_terms] group_sum(vec4 own[group_terms]) {
    uint index = gl_LocalInvocationIndex;
    group_values[index] = own;
    for (uint count = 32u; count > 0u; count /= 2u) {
        barrier();
        for (uint i = 0u; i < group_terms && index < count; ++i)
            group_values[index][i] += group_values[index + count][i];
    }
    barrier();
    return group_values[0];
}
#endif
