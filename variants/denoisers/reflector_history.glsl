// The reflection at a place of the previous frame.
#ifndef DENOISERS_REFLECTOR_HISTORY_GLSL
#define DENOISERS_REFLECTOR_HISTORY_GLSL
#include "denoisers/place_before.glsl"
#include "denoisers/same_reflector.glsl"

// Texels of previous_accumulated: colour times confidence, confidence; the latter negative where nothing reflected.
uniform sampler2D previous_accumulated;

const vec4 no_reflection = vec4(0.0, 0.0, 0.0, -1.0);

struct History {
    vec4 color;  // as texels of previous_accumulated
    bool is_found;
};

const History no_history = History(vec4(0.0), false);

// Bilinear, of those of the four texels that showed the same reflector.
History history_at(ivec2 pixel, Place place) {
    bool is_inside = all(greaterThanEqual(place.position, vec2(0.0))) &&
                     all(lessThan(place.position, camera.extent.xy));
    if (!place.is_known || !is_inside) return no_history;
    Reflector now = reflector_at(pixel);
    vec2 corner = floor(place.position - 0.5), share = place.position - 0.5 - corner;
    vec4 sum = vec4(0.0);
    float sum_of_weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1), texel = ivec2(corner) + side;
        if (!is_on_screen(texel) || !is_same_reflector(now, texel)) continue;
        vec4 before = texelFetch(previous_accumulated, texel, 0);
        if (before.a < 0.0) continue;
        vec2 weights = mix(1.0 - share, share, vec2(side));
        sum += weights.x * weights.y * before;
        sum_of_weights += weights.x * weights.y;
    }
    return sum_of_weights > 0.0 ? History(sum / sum_of_weights, true) : no_history;
}
#endif
