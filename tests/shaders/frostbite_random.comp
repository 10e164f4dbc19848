// random_pair() of every pixel.
#include "frostbite_sssr/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Number { uint k, dimension; };
uniform writeonly image2D found;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(found)))) return;
    imageStore(found, pixel, vec4(random_pair(pixel, k, dimension), 0.0, 0.0));
}
