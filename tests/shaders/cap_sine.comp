// cap_sine() of DiligentFX's ray for the floats from 4 below to 4 above 2, the height of a whole sphere.
#include "diligent_ssr/ray.glsl"
layout(local_size_x = 9) in;
writeonly buffer Sines { float sines[]; };

void main() {
    uint index = gl_LocalInvocationIndex;
    sines[index] = cap_sine(uintBitsToFloat(floatBitsToUint(2.0) - 4u + index));
}
