// Whether a pixel traces a ray, takes the ray of a neighbour in its 2x2 quad, or needs none.
#ifndef AMD_SSSR_CLASSIFICATION_GLSL
#define AMD_SSSR_CLASSIFICATION_GLSL
#include "amd_sssr/lists.glsl"
#include "common/mirror_ray.glsl"

uniform sampler2D fallback, previous_variance;
uniform writeonly image2D roughness, radiance, confidence;

struct Pixel {
    bool is_surface;
    bool is_glossy;  // a surface with a specular term, smooth enough to be traced
    bool is_mirror;
    float alpha;     // 1 without a specular term, so that no later pass takes the pixel for a glossy one
};

Pixel classify(ivec2 position) {
    Pixel pixel = Pixel(false, false, false, 1.0);
    if (!is_on_screen(position)) return pixel;
    pixel.is_surface = !is_background(texelFetch(depth, position, 0).r);
    if (!pixel.is_surface || !has_specular(position)) return pixel;
    float perceptual = texelFetch(normal, position, 0).w;
    pixel.alpha = perceptual * perceptual;
    pixel.is_glossy = is_glossy(pixel.alpha);
    pixel.is_mirror = is_mirror(pixel.alpha);
    return pixel;
}

// Quad by quad, so that rays that are listed one after the other lie together; the pixels of a quad lie in the order
// (0, 0), (1, 0), (0, 1), (1, 1).
ivec2 position_in_tile(uint index) {
    return ivec2((index & 1u) | (index >> 2 & 6u), (index >> 1 & 3u) | (index >> 3 & 4u));
}

// The pixels of a quad whose rays serve the others: one, two on the diagonal, or all of them.
bool traces_for_quad(ivec2 position) {
    ivec2 odd = position & 1;
    return samples_per_quad == 1u ? odd == ivec2(0) : samples_per_quad == 2u ? odd.x == odd.y : true;
}

const uint is_tracing = 1u, is_waiting = 2u;

// Before it is known whether another pixel traces for it.
uint state_of(Pixel pixel, ivec2 position) {
    bool traces = pixel.is_glossy && (pixel.is_mirror || traces_for_quad(position));
    if (guided_tracing && pixel.is_glossy && !traces)
        traces = texelFetch(previous_variance, position, 0).r > variance_threshold;
    return traces ? is_tracing : pixel.is_glossy ? is_waiting : 0u;
}

// A pixel's place in its quad, and the states of its neighbours there: defined by the pass. `flip`: 1 across, 2 down, 3
// both.
uint place_in_quad();
bool neighbour_is(uint flip, uint state);

// A pixel that takes a ray which no pixel traces.
bool is_orphan(uint state) {
    uint server = samples_per_quad == 1u ? place_in_quad() : 1u;  // the flip that leads to it
    return state == is_waiting && !neighbour_is(server, is_tracing);
}

uint copy_flags(ivec2 position) {
    if (samples_per_quad > 2u || !traces_for_quad(position)) return 0u;
    uint flags = neighbour_is(1u, is_waiting) ? copy_horizontal : 0u;
    if (samples_per_quad == 1u) {
        if (neighbour_is(2u, is_waiting)) flags |= copy_vertical;
        if (neighbour_is(3u, is_waiting)) flags |= copy_diagonal;
    }
    return flags;
}

void list_tile(ivec2 start) { listed_tile[atomicAdd(tiles_being_listed, 1u)] = pack_tile(start); }

void store_classified(Pixel pixel, ivec2 position) {
    if (!is_on_screen(position)) return;
    vec3 environment = ibl_factor * texelFetch(fallback, position, 0).rgb;
    imageStore(radiance, position, vec4(pixel.is_surface && !pixel.is_glossy ? environment : vec3(0.0), 0.0));
    imageStore(roughness, position, vec4(pixel.alpha));
    imageStore(confidence, position, vec4(pixel.is_glossy));
}
#endif
