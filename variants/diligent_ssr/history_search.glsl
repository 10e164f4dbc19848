// The previous frame's result for a surface, at or near its position, unless something else was in front of it.
#include "diligent_ssr/history_taps.glsl"
#include "core/shaders/view.glsl"

uniform sampler2D previous_depth;

const uint by_device_depth = 1u;  // of history_search

// How alike two distances from the camera plane must be, from 0 to 1: 0.9 leaves a difference of a tenth.
const float alike = 0.9;
const float alike_enough_for_a_tap = 0.45;
const float least_weight_found = 0.1;

struct History {
    vec4 radiance;
    vec2 position;  // pixels of the previous frame
    bool is_found;
};

float camera_depth_before(float device_depth) {
    vec4 view = camera.previous_view_from_clip * vec4(0.0, 0.0, device_depth, 1.0);
    return -view.z / view.w;
}

bool is_inside(vec2 position) {
    return all(greaterThanEqual(position, vec2(0.0))) && all(lessThan(position, camera.extent.xy));
}

// Beyond the screen 0, as the original reads there.
float device_depth_before(ivec2 texel) {
    return texel == clamped_to_screen(texel) ? texelFetch(previous_depth, texel, 0).r : 0.0;
}

// Of two distances from the camera plane (m).
float likeness(float now, float before) {
    float difference = abs(now - before);
    float scale = history_search == by_device_depth ? now : max(max(now, before), 1e-6);
    return exp(-difference / scale);
}

// Whether texels with `before` in the depth buffer show something `now` away.
bool is_alike(float now, float before, float least) { return likeness(now, camera_depth_before(before)) > least; }

// Line by line; or the nearest first, of equally near ones the upper and left.
const ivec2 centered_shifts[9] = ivec2[9](ivec2(0, 0), ivec2(0, -1), ivec2(-1, 0), ivec2(1, 0), ivec2(0, 1),
                                          ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 1), ivec2(1, 1));

vec2 shift_of(int i) { return vec2(centered_search ? centered_shifts[i] : ivec2(i % 3, i / 3) - 1); }

// 2026: of the nine positions the one around which most texels show the surface; these make the colour.
History search_by_camera_depth(vec2 position, float now) {
    History best = History(vec4(0.0), position, false);
    float best_weight = 0.0;
    for (int i = 0; i < 9 && best_weight <= alike; ++i) {
        Taps taps = taps_at(position + shift_of(i));
        vec4 sum = vec4(0.0);
        float weight = 0.0;
        for (int tap = 0; tap < 4; ++tap) {
            ivec2 texel = clamped_to_screen(texel_of(taps, tap));
            if (!is_alike(now, texelFetch(previous_depth, texel, 0).r, alike_enough_for_a_tap)) continue;
            sum += weight_of(taps, tap) * texelFetch(previous_accumulated_radiance, texel, 0);
            weight += weight_of(taps, tap);
        }
        if (weight <= best_weight) continue;
        best_weight = weight;
        best = History(sum / weight, position + shift_of(i), weight > least_weight_found);
    }
    return best;
}

// 2024: among the texels around a position, those that show the surface, if the mean of their values in the depth
// buffer is alike, too.
History taps_that_show(vec2 position, float now) {
    Taps taps = taps_at(position);
    vec4 sum = vec4(0.0);
    float depth_sum = 0.0, weight = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = texel_of(taps, i);
        float before = device_depth_before(texel);
        if (!is_alike(now, before, alike_enough_for_a_tap)) continue;
        if (texel == clamped_to_screen(texel))
            sum += weight_of(taps, i) * texelFetch(previous_accumulated_radiance, texel, 0);
        depth_sum += weight_of(taps, i) * before;
        weight += weight_of(taps, i);
    }
    float total = max(weight, 1e-6);
    return History(sum / total, position, is_alike(now, depth_sum / total, alike));
}

// 2024: of the nine positions the one whose filtered value of the depth buffer is most alike.
History search_by_device_depth(vec2 position, float now) {
    vec2 best = position;
    float best_likeness = 0.0;
    for (int i = 0; i < 9; ++i) {
        vec2 shifted = position + shift_of(i);
        float found = likeness(now, camera_depth_before(filtered(previous_depth, shifted).r));
        if (found <= best_likeness) continue;
        best_likeness = found;
        best = shifted;
    }
    if (best_likeness > alike) return History(radiance_before(best), best, true);
    return taps_that_show(best, now);
}

// `now`: distance of the surface from the camera plane as the previous camera saw it (m).
History history_near(vec2 position, float now) {
    bool is_found = is_alike(now, device_depth_before(ivec2(position)), alike);
    History history = History(radiance_before(position), position, is_found);
    // No ternary: browsers refuse it for structures, which GLSL ES 3.00 itself allows.
    if (!history.is_found) {
        if (history_search == by_device_depth)
            history = search_by_device_depth(position, now);
        else
            history = search_by_camera_depth(position, now);
    }
    history.is_found = history.is_found && is_inside(history.position);
    return history;
}
