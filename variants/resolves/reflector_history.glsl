// What was reflected at a place of the frame before.
#ifndef RESOLVES_REFLECTOR_HISTORY_GLSL
#define RESOLVES_REFLECTOR_HISTORY_GLSL
#include "frostbite_sssr/previous_view.glsl"
#include "resolves/place_before.glsl"

// Texels of previous_accumulated: colour times confidence, confidence; the latter negative where nothing reflected.
uniform sampler2D previous_accumulated, previous_normal;

const vec4 no_reflection = vec4(0.0, 0.0, 0.0, -1.0);

// As the previous camera would see it: positions and the geometric normal in its view space, the shading normal in
// world space.
struct Reflector {
    vec3 position, geometric_normal, ws_normal;
    float roughness;
};

Reflector reflector_at(ivec2 pixel) {
    vec4 normal_roughness = texelFetch(normal, pixel, 0);
    return Reflector((camera.previous_view_from_world * world_position(pixel)).xyz, geometric_normal_before(pixel),
                     normal_roughness.xyz, normal_roughness.w);
}

// Whether the texel showed the same plane as rough as now; one that moved has its mirror image elsewhere. The limits
// are ours: 26 degrees, a tenth in perceptual roughness.
bool is_same_reflector(Reflector now, ivec2 texel) {
    vec4 before = texelFetch(previous_normal, texel, 0);
    return showed_plane(texel, now.position, now.geometric_normal) && dot(before.xyz, now.ws_normal) >= 0.9 &&
           abs(before.w - now.roughness) <= 0.1;
}

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
