// Stores one value in every pixel.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { vec4 value; };
uniform writeonly image2D target;
void main() { imageStore(target, ivec2(gl_GlobalInvocationID.xy), value); }
