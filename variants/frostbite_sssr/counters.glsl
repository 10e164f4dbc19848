// How many rays are listed, and how the tracers go through them; see the buffers in technique.json.
#ifndef FROSTBITE_SSSR_COUNTERS_GLSL
#define FROSTBITE_SSSR_COUNTERS_GLSL

buffer counters { uint smooth_count, rough_count; };

// For groups of 64 that indirect_arguments started.
uint place_in_list() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
}
#endif
