// random_pair() of every pixel. `dimension`: which of those that are in use.
#include "frostbite_sssr/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Number { uint k, dimension; };
uniform writeonly image2D found;

// Those of rays and probes: the first two draws and the march.
const uint used[7] = uint[7](ray_dimension, ray_dimension + 1u, ray_dimension + march_dimension, probe_dimension,
                             probe_dimension + 1u, probe_dimension + march_dimension, tap_dimension);

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(found)))) return;
    imageStore(found, pixel, vec4(random_pair(pixel, k, used[dimension]), 0.0, 0.0));
}
