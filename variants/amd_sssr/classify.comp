// Decides for each pixel whether it traces a ray, and lists rays and the 8x8 tiles to be denoised.
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "amd_sssr/classification.glsl"

layout(local_size_x = 64) in;

// Shared memory, not quad operations: subgroups need not hold quads.
shared uint quad_states[64];
uint place_in_quad() { return gl_LocalInvocationIndex & 3u; }
bool neighbour_is(uint flip, uint state) { return (quad_states[gl_LocalInvocationIndex ^ flip] & state) != 0u; }

// One atomic for all invocations of a subgroup.
void list_ray(bool is_listed, uint ray) {
    uvec4 ballot = subgroupBallot(is_listed);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(rays_being_listed, subgroupBallotBitCount(ballot));
    first = subgroupBroadcastFirst(first);
    if (is_listed) listed_ray[first + subgroupBallotExclusiveBitCount(ballot)] = ray;
}

shared bool subgroup_is_glossy[64];

bool is_group_glossy() {
    for (uint i = 0u; i < gl_NumSubgroups; ++i)
        if (subgroup_is_glossy[i]) return true;
    return false;
}

void main() {
    ivec2 start = ivec2(gl_WorkGroupID.xy) * 8, position = start + position_in_tile(gl_LocalInvocationIndex);
    Pixel pixel = classify(position);
    uint state = state_of(pixel, position);
    quad_states[gl_LocalInvocationIndex] = state;
    bool any_glossy = subgroupAny(pixel.is_glossy);
    if (subgroupElect()) subgroup_is_glossy[gl_SubgroupID] = any_glossy;
    barrier();
    bool traces = state == is_tracing || (trace_orphans && is_orphan(state));
    list_ray(traces, pack_ray(position) | copy_flags(position));
    if (gl_LocalInvocationIndex == 0u && is_group_glossy()) list_tile(start);
    store_classified(pixel, position);
}
