// Guesses what lies in directions that the screen never showed.
#include "common/screen_probe/octahedral_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D probe_seen, probe_facts, probe_lit, probe_unoccluded;  // of gather.comp
uniform writeonly image2D screen_probe, screen_probe_nearness;

// How much a direction says about another one: inverse distances (Shepard 1968), in which a turn about the vertical, y in
// glTF, counts as less than one up or down. The numbers are ours.
float likeness(vec3 a, vec3 b) {
    const float of_turns = 0.3, blunt = 0.02, sharpness = 3.0;
    vec3 difference = (a - b) * vec3(of_turns, 1.0, of_turns);
    return pow(blunt + dot(difference, difference), -sharpness);
}

struct Guess {
    vec4 surfaces;  // as of ScreenProbe
    float nearness;
};

// Whether the environment lights the scene from a direction, as far as surfaces tell that face it: they are as bright as
// it alone makes them. Darker ones are shaded from it; what is brighter is lit by lamps and says nothing.
float lit_from(vec3 direction, vec4 lit, vec4 unoccluded) {
    float expected = unoccluded.w + dot(unoccluded.xyz, direction), found = lit.w + dot(lit.xyz, direction);
    if (expected <= 0.0) return 0.0;
    // Ours: below the first walls of furnished rooms that light each other would count as lit from outside.
    const float shaded = 0.5, in_the_open = 0.9, beside_lamps = 1.3, by_lamps = 2.5;
    float ratio = found / expected;
    return smoothstep(shaded, in_the_open, ratio) * (1.0 - smoothstep(beside_lamps, by_lamps, ratio));
}

Guess guess_at(vec3 direction) {
    const int blocks = probe_width / 2;  // of 2x2 texels, whose mean a sampler gives at their common corner
    const float doubt = 1e-3;  // weight of there being nothing
    vec4 surfaces = vec4(0.0), lit = vec4(0.0), unoccluded = vec4(0.0);
    float nearness = 0.0, weights = doubt;
    for (int i = 0; i < blocks * blocks; ++i) {
        vec2 corner = (vec2(i % blocks, i / blocks) + 0.5) / float(blocks);
        vec2 facts = textureLod(probe_facts, corner, 0.0).xy;
        lit += textureLod(probe_lit, corner, 0.0);
        unoccluded += textureLod(probe_unoccluded, corner, 0.0);
        if (facts.y == 0.0) continue;
        float weight = likeness(octahedral_direction(2.0 * corner - 1.0), direction);
        surfaces += weight * textureLod(probe_seen, corner, 0.0);
        nearness += weight * facts.x;
        weights += weight * facts.y;
    }
    if (surfaces.a == 0.0) return Guess(vec4(0.0), 0.0);
    // Where the sky shows between things there is more of it beyond the screen; a window in a wall is no sky.
    const float open = 0.4, closed = 0.9;
    float share = smoothstep(open, closed, surfaces.a / weights);
    share *= 1.0 - lit_from(direction, lit, unoccluded);
    return Guess(share / surfaces.a * surfaces, nearness / surfaces.a);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(probe_width + 2)))) return;
    vec2 place = place_within(2.0 * (vec2(texel) - 0.5) / float(probe_width) - 1.0);
    Guess guess = guess_at(octahedral_direction(place));
    ivec2 inside = ivec2((0.5 * place + 0.5) * float(probe_width));
    vec4 seen = texelFetch(probe_seen, inside, 0);
    vec2 facts = texelFetch(probe_facts, inside, 0).xy;
    float of_guess = 1.0 - facts.y, nearness = of_guess * guess.surfaces.a * guess.nearness + facts.x;
    vec4 surfaces = of_guess * guess.surfaces + seen;
    imageStore(screen_probe, texel, surfaces);
    imageStore(screen_probe_nearness, texel, vec4(surfaces.a > 0.0 ? nearness / surfaces.a : 0.0));
}
