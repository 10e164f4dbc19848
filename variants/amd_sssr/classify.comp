// Decides for each pixel whether it traces a ray, takes that of a neighbour in its 2x2 quad, or needs none, and lists
// rays and the 8x8 tiles to be denoised.
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "amd_sssr/lists.glsl"
#include "common/mirror_ray.glsl"

layout(local_size_x = 64) in;
uniform sampler2D fallback, previous_variance;
uniform writeonly image2D roughness, radiance, confidence;
buffer tile_list { uint listed_tile[]; };

struct Pixel {
    bool is_surface;
    bool is_glossy;  // a surface with a specular term, smooth enough to be traced
    bool is_mirror;
    float alpha;     // 1 without a specular term, so that no later pass takes the pixel for a glossy one
};

Pixel classify(ivec2 position) {
    Pixel pixel = Pixel(false, false, false, 1.0);
    if (!is_on_screen(position)) return pixel;
    pixel.is_surface = !is_background(texelFetch(depth, position, 0).r);
    if (!pixel.is_surface || !has_specular(position)) return pixel;
    float perceptual = texelFetch(normal, position, 0).w;
    pixel.alpha = perceptual * perceptual;
    pixel.is_glossy = is_glossy(pixel.alpha);
    pixel.is_mirror = is_mirror(pixel.alpha);
    return pixel;
}

// Invocations go through the tile quad by quad, so that rays that are listed one after the other lie together.
ivec2 position_in_tile(uint index) {
    return ivec2((index & 1u) | (index >> 2 & 6u), (index >> 1 & 3u) | (index >> 3 & 4u));
}

// The pixels of a quad whose rays serve the others: one, two on the diagonal, or all of them.
bool traces_for_quad(ivec2 position) {
    ivec2 odd = position & 1;
    return samples_per_quad == 1u ? odd == ivec2(0) : samples_per_quad == 2u ? odd.x == odd.y : true;
}

// Shared memory, not quad operations: subgroups need not hold quads.
const uint is_tracing = 1u, is_waiting = 2u;
shared uint quad_states[64];
bool neighbour_is(uint flip, uint state) { return (quad_states[gl_LocalInvocationIndex ^ flip] & state) != 0u; }

// A pixel that takes a ray which no pixel traces. Quads lie in the list of invocations as (0, 0), (1, 0), (0, 1),
// (1, 1).
bool is_orphan(uint state) {
    uint server = samples_per_quad == 1u ? gl_LocalInvocationIndex & 3u : 1u;  // the flip that leads to it
    return state == is_waiting && !neighbour_is(server, is_tracing);
}

uint copy_flags(ivec2 position) {
    if (samples_per_quad > 2u || !traces_for_quad(position)) return 0u;
    uint flags = neighbour_is(1u, is_waiting) ? copy_horizontal : 0u;
    if (samples_per_quad == 1u) {
        if (neighbour_is(2u, is_waiting)) flags |= copy_vertical;
        if (neighbour_is(3u, is_waiting)) flags |= copy_diagonal;
    }
    return flags;
}

// One atomic for all invocations of a subgroup.
void list_ray(bool is_listed, uint ray) {
    uvec4 ballot = subgroupBallot(is_listed);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(rays_being_listed, subgroupBallotBitCount(ballot));
    first = subgroupBroadcastFirst(first);
    if (is_listed) listed_ray[first + subgroupBallotExclusiveBitCount(ballot)] = ray;
}

shared bool subgroup_is_glossy[64];

void list_tile() {
    bool is_listed = false;
    for (uint i = 0u; i < gl_NumSubgroups; ++i) is_listed = is_listed || subgroup_is_glossy[i];
    if (is_listed) listed_tile[atomicAdd(tiles_being_listed, 1u)] = gl_WorkGroupID.y * 8u << 16 | gl_WorkGroupID.x * 8u;
}

void main() {
    ivec2 position = ivec2(gl_WorkGroupID.xy) * 8 + position_in_tile(gl_LocalInvocationIndex);
    Pixel pixel = classify(position);
    bool traces = pixel.is_glossy && (pixel.is_mirror || traces_for_quad(position));
    if (guided_tracing && pixel.is_glossy && !traces)
        traces = texelFetch(previous_variance, position, 0).r > variance_threshold;

    uint state = traces ? is_tracing : pixel.is_glossy ? is_waiting : 0u;
    quad_states[gl_LocalInvocationIndex] = state;
    bool any_glossy = subgroupAny(pixel.is_glossy);
    if (subgroupElect()) subgroup_is_glossy[gl_SubgroupID] = any_glossy;
    barrier();
    if (trace_orphans && is_orphan(state)) traces = true;
    list_ray(traces, pack_ray(position) | copy_flags(position));
    if (gl_LocalInvocationIndex == 0u) list_tile();

    if (!is_on_screen(position)) return;
    vec3 environment = ibl_factor * texelFetch(fallback, position, 0).rgb;
    imageStore(radiance, position, vec4(pixel.is_surface && !pixel.is_glossy ? environment : vec3(0.0), 0.0));
    imageStore(roughness, position, vec4(pixel.alpha));
    imageStore(confidence, position, vec4(pixel.is_glossy));
}
