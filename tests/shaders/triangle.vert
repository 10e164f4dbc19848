// Positions in clip space from a buffer: three floats per vertex.
layout(std430) readonly buffer positions { float position[]; };
layout(location = 0) flat out uint instance;
void main() {
    int first = 3 * gl_VertexIndex;
    gl_Position = vec4(position[first], position[first + 1], position[first + 2], 1.0);
    instance = uint(gl_InstanceIndex);
}
