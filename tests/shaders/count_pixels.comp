// Adds one to a pixel of an image of counters for every invocation of its 8 x 8 block.
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32ui) uniform uimage2D counters;
void main() { imageAtomicAdd(counters, ivec2(gl_WorkGroupID.xy), 1u); }
