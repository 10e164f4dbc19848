#include "common/blue_noise.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D blue_noise;

void main() { imageStore(blue_noise, ivec2(gl_GlobalInvocationID.xy), vec4(numbers_of(gl_GlobalInvocationID.xy), 0.0, 0.0)); }
