// Appends the index of every pixel above `threshold` to a list, and counts them for an indirect dispatch.
#extension GL_KHR_shader_subgroup_ballot : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { float threshold; };
uniform sampler2D source;
layout(std430) buffer pixel_list { uint pixels[]; };
layout(std430) buffer arguments { uint groups_x, groups_y, groups_z, count; };
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(source, 0);
    bool is_bright = all(lessThan(pixel, size)) && texelFetch(source, pixel, 0).r > threshold;
    uvec4 ballot = subgroupBallot(is_bright);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(count, subgroupBallotBitCount(ballot));
    first = subgroupBroadcastFirst(first);
    if (is_bright) {
        uint slot = first + subgroupBallotExclusiveBitCount(ballot);
        pixels[slot] = uint(pixel.y * size.x + pixel.x);
        atomicMax(groups_x, slot / 64u + 1u);
        groups_y = 1u;
        groups_z = 1u;
    }
}
