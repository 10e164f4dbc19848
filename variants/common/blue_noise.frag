#include "common/blue_noise.glsl"
layout(location = 0) out vec2 blue_noise;

void main() { blue_noise = numbers_of(uvec2(gl_FragCoord.xy)); }
