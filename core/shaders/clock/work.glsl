// `iterations` of a chain that no compiler can shorten, so that time is proportional to it.
layout(push_constant) uniform Push { int iterations; };
vec4 work(vec2 seed) {
    float x = fract(seed.x * 0.123 + seed.y * 0.456);
    for (int i = 0; i < iterations; ++i) x = 3.7 * x * (1.0 - x);
    return vec4(x);
}
