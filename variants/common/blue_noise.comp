#include "common/blue_noise.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D blue_noise;

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy;
    imageStore(blue_noise, ivec2(texel), vec4(numbers_of(texel), 0.0, 0.0));
}
