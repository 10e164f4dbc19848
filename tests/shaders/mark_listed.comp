// Writes 1 to every pixel of the list; dispatched indirectly, so that only listed pixels cost anything.
layout(local_size_x = 64) in;
layout(std430) readonly buffer pixel_list { uint pixels[]; };
layout(std430) buffer arguments { uint groups_x, groups_y, groups_z, count; };
layout(std430) buffer invocations { uint invocation_count; };
uniform writeonly image2D marks;
void main() {
    atomicAdd(invocation_count, 1u);
    if (gl_GlobalInvocationID.x >= count) return;
    int index = int(pixels[gl_GlobalInvocationID.x]), width = imageSize(marks).x;
    imageStore(marks, ivec2(index % width, index / width), vec4(1.0));
}
