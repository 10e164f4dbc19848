// 1024 times 16 bytes of shared memory, in workgroups of 64.
layout(local_size_x = 64) in;
layout(rgba32f) uniform writeonly image2D target;
shared vec4 values[1024];

void main() {
    uint i = gl_LocalInvocationIndex;
    for (uint k = 0u; k < 16u; ++k) values[i + 64u * k] = vec4(float(i * k));
    barrier();
    imageStore(target, ivec2(gl_GlobalInvocationID.xy), values[(i * 37u + gl_WorkGroupID.x) & 1023u]);
}
