#include "clock/work.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D result;
void main() { imageStore(result, ivec2(gl_GlobalInvocationID.xy), work(vec2(gl_GlobalInvocationID.xy))); }
