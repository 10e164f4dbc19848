// What a pixel reflected in earlier frames, and how far that is still valid.
#ifndef RATIO_ACCUMULATION_HISTORY_GLSL
#define RATIO_ACCUMULATION_HISTORY_GLSL
#include "denoisers/place_before.glsl"
#include "denoisers/ratio_accumulation/state.glsl"
#include "denoisers/same_reflector.glsl"

// Of the images of state.glsl.
uniform sampler2D previous_accumulated, previous_moments, previous_reflected_length;

// Where what a mirror shows at that length was; what is rough, and what no ray met, keeps to its surface.
Place place_of(ivec2 pixel, Receiver receiver, float ray_length) {
    if (receiver.roughness >= surface_roughness || ray_length == 0.0) return Place(surface_before(pixel), true);
    return place_before(vec4(receiver.position + ray_length * view_direction(receiver.position), 1.0));
}

// Up to rounding.
bool stays(ivec2 pixel, Place place) {
    const float nothing = 0.05;  // pixels
    vec2 away = abs(place.position - vec2(pixel) - 0.5);
    return max(away.x, away.y) < nothing;
}

State state_at(ivec2 texel) {
    return State(shown_color(texelFetch(previous_accumulated, texel, 0)), texelFetch(previous_moments, texel, 0),
                 texelFetch(previous_reflected_length, texel, 0).r);
}

// Mean of those of the four texels around a place that showed the same plane; without any its weight is 0.
State history_at(ivec2 pixel, Receiver receiver, Place place) {
    bool is_inside = all(greaterThanEqual(place.position, vec2(0.0))) &&
                     all(lessThan(place.position, camera.extent.xy));
    if (!place.is_known || !is_inside) return no_state;
    vec4 ws_position = camera.world_from_view * vec4(receiver.position, 1.0);
    Reflector now = Reflector((camera.previous_view_from_world * ws_position).xyz, geometric_normal_before(pixel),
                              receiver.ws_normal, receiver.roughness);
    vec2 corner = floor(place.position - 0.5), share = place.position - 0.5 - corner;
    bool is_still = stays(pixel, place);  // then one texel holds it all
    if (is_still) {
        corner = vec2(pixel);
        share = vec2(0.0);
    }
    int count = is_still ? 1 : 4;
    State sum = no_state;
    float weights = 0.0;
    for (int i = 0; i < count; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1), texel = ivec2(corner) + side;
        if (!is_on_screen(texel) || !is_same_reflector(now, texel)) continue;
        State state = state_at(texel);
        if (state.moments.x == 0.0) continue;
        vec2 sides = mix(1.0 - share, share, vec2(side));
        float weight = sides.x * sides.y;
        sum.shown += weight * state.shown;
        sum.moments += weight * state.moments;
        sum.ray_length += weight * state.ray_length;
        weights += weight;
    }
    if (weights == 0.0) return no_state;
    return State(sum.shown / weights, sum.moments / weights, sum.ray_length / weights);
}

// Weight of history that was in another place. What is read between texels blurs, which wide lobes hide; and what was
// farther away or nearer than what is reflected now, by so many pixels of parallax, was not this.
float moved_weight(ivec2 pixel, Receiver receiver, Place place, State before) {
    float weight = before.moments.x;
    if (receiver.roughness >= surface_roughness) return weight;
    weight = min(weight, mix(moving_history, max_history, receiver.roughness / surface_roughness));
    Place other = place_of(pixel, receiver, before.ray_length);
    if (!other.is_known) return 0.0;
    float apart = length(other.position - place.position) / (1.0 + parallax_of_roughness * receiver.roughness);
    return weight / (1.0 + apart * apart);
}

// What is left of what was reflected before.
State history_of(ivec2 pixel, Receiver receiver, float ray_length) {
    if (scene_is_still) return state_at(pixel);
    Place place = place_of(pixel, receiver, ray_length);
    State before = history_at(pixel, receiver, place);
    if (!stays(pixel, place)) before.moments.x = moved_weight(pixel, receiver, place, before);
    return before;
}

// Pixels by which what the pixel's own ray hit moved in a frame beside what the camera's motion moved it.
float motion_of_hit(ivec2 pixel) {
    uint target = hit_of_ray[index_of_ray(traced_of_pixel(pixel), 0u)].x;
    if (scene_is_still || target >= ray_into_surface) return 0.0;
    ivec2 hit = pixel_of_target(target);
    Place still = place_before(vec4(view_position(hit), 1.0));
    return still.is_known ? length(still.position - surface_before(hit)) : 0.0;
}
#endif
