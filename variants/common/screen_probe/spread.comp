// Guesses what lies in directions that the screen never showed. A workgroup makes a texel of the map, from all blocks of
// 2x2 texels of gather.comp at once.
#include "common/screen_probe/octahedral_map.glsl"
const uint group_terms = 5u;
#include "common/screen_probe/group_sum.glsl"

layout(local_size_x = 8, local_size_y = 8) in;  // half of probe_width
uniform sampler2D probe_seen, probe_facts, probe_lit, probe_unoccluded, probe_environment;  // of gather.comp
uniform writeonly image2D screen_probe, screen_probe_nearness;
uniform writeonly image2D probe_moments;  // of probe_environment: mean over all directions

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

// Weighted sums over blocks.
struct Blocks {
    vec4 surfaces;
    float nearness, weight;
    vec4 lit, unoccluded, environment;
};

// A sampler gives a block's mean at the common corner of its texels.
Blocks block_at(ivec2 block, vec3 direction) {
    vec2 corner = (vec2(block) + 0.5) / vec2(gl_WorkGroupSize.xy);
    vec2 facts = textureLod(probe_facts, corner, 0.0).xy;
    float weight = likeness(octahedral_direction(2.0 * corner - 1.0), direction);
    return Blocks(weight * textureLod(probe_seen, corner, 0.0), weight * facts.x, weight * facts.y,
                  textureLod(probe_lit, corner, 0.0), textureLod(probe_unoccluded, corner, 0.0),
                  textureLod(probe_environment, corner, 0.0));
}

Blocks sum_over_group(Blocks own) {
    vec4 terms[group_terms] = vec4[group_terms](own.surfaces, own.lit, own.unoccluded, own.environment,
                                                vec4(own.nearness, own.weight, 0.0, 0.0));
    terms = group_sum(terms);
    return Blocks(terms[0], terms[4].x, terms[4].y, terms[1], terms[2], terms[3]);
}

Guess guess_from(Blocks blocks, vec3 direction) {
    const float doubt = 1e-3;  // weight of there being nothing
    vec4 surfaces = blocks.surfaces;
    if (surfaces.a == 0.0) return Guess(vec4(0.0), 0.0);
    // Where the sky shows between things there is more of it beyond the screen; a window in a wall is no sky.
    const float open = 0.4, closed = 0.9;
    float share = smoothstep(open, closed, surfaces.a / (doubt + blocks.weight));
    share *= 1.0 - lit_from(direction, blocks.lit, blocks.unoccluded);
    return Guess(share / surfaces.a * surfaces, blocks.nearness / surfaces.a);
}

void main() {
    ivec2 texel = ivec2(gl_WorkGroupID.xy);
    vec2 place = place_within(2.0 * (vec2(texel) - 0.5) / float(probe_width) - 1.0);
    vec3 direction = octahedral_direction(place);
    Blocks blocks = sum_over_group(block_at(ivec2(gl_LocalInvocationID.xy), direction));
    if (gl_LocalInvocationIndex != 0u) return;
    if (texel == ivec2(0)) imageStore(probe_moments, texel, 4.0 * blocks.environment);
    Guess guess = guess_from(blocks, direction);
    ivec2 inside = ivec2((0.5 * place + 0.5) * float(probe_width));
    vec4 seen = texelFetch(probe_seen, inside, 0);
    vec2 facts = texelFetch(probe_facts, inside, 0).xy;
    float of_guess = 1.0 - facts.y, nearness = of_guess * guess.surfaces.a * guess.nearness + facts.x;
    vec4 surfaces = of_guess * guess.surfaces + seen;
    imageStore(screen_probe, texel, surfaces);
    imageStore(screen_probe_nearness, texel, vec4(surfaces.a > 0.0 ? nearness / surfaces.a : 0.0));
}
