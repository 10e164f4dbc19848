// Arguments for the lobe's functions, one set per pixel of 256x256, to the bit the same in float and in double.
#include "common/ggx_lobe.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { float alpha; };

ivec2 pixel() { return ivec2(gl_GlobalInvocationID.xy); }
vec2 random_numbers() { return (vec2(pixel()) + 0.5) / 256.0; }

// Towards the viewer; its cosine to the normal takes every value of k / 1024.
vec3 viewer() {
    float mu = float((pixel().y * 256 + pixel().x) * 97 % 1024 + 1) / 1024.0;
    return vec3(sqrt(1.0 - mu * mu), 0.0, mu);
}
