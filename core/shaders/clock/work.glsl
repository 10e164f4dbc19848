// `iterations` of a chain that no compiler can shorten, so that time is proportional to it. An iteration is 256 steps:
// lavapipe leaves a loop after 65535 rounds (LP_MAX_TGSI_LOOP_ITERATIONS of Mesa's gallivm).
layout(push_constant) uniform Push { int iterations; };
float one(float x) { return 3.7 * x * (1.0 - x); }
float four(float x) { return one(one(one(one(x)))); }
float sixteen(float x) { return four(four(four(four(x)))); }
float sixty_four(float x) { return sixteen(sixteen(sixteen(sixteen(x)))); }
vec4 work(vec2 seed) {
    float x = fract(seed.x * 0.123 + seed.y * 0.456);
    for (int i = 0; i < iterations; ++i) x = sixty_four(sixty_four(sixty_four(sixty_four(x))));
    return vec4(x);
}
