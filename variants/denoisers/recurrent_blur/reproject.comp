// Finds each pixel's reflection in the previous frame, and how many frames it holds. Looks at two places: where the
// surface was, and where a flat mirror showed what the pixel's rays meet.
#include "common/ycocg.glsl"
#include "frostbite_sssr/previous_view.glsl"
#include "denoisers/place_before.glsl"
#include "denoisers/recurrent_blur/ray_statistics.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D previous_normal, previous_blurred, previous_age;
uniform writeonly image2D reprojected, reprojected_age;

struct Neighborhood {
    vec4 mean, deviation;      // of damped colours of 3x3 pixels, as ycocg_of() has them
    float mean_length;         // m, of those with hits
    float length_deviation;    // m
    float share_of_misses;
};

Neighborhood neighborhood_of(ivec2 pixel) {
    vec4 sum = vec4(0.0), squares = vec4(0.0);
    vec3 lengths = vec3(0.0);  // 1, length, its square
    for (int i = 0; i < 9; ++i) {
        ivec2 neighbor = clamped_to_screen(pixel + ivec2(i % 3, i / 3) - 1);
        vec4 color = ycocg_of(damped(traced_color(neighbor)));
        sum += color;
        squares += color * color;
        float ray_length = texelFetch(own_length, neighbor, 0).r;
        if (ray_length > 0.0) lengths += vec3(1.0, ray_length, ray_length * ray_length);
    }
    vec4 mean = sum / 9.0;
    vec2 moments = lengths.yz / max(lengths.x, 1.0);
    return Neighborhood(mean, sqrt(max(squares / 9.0 - mean * mean, 0.0)), moments.x,
                        sqrt(max(moments.y - moments.x * moments.x, 0.0)), 1.0 - lengths.x / 9.0);
}

Place mirror_image_before(vec3 position, Neighborhood around) {
    vec3 towards_surface = view_direction(position);
    bool is_infinite = reproject_misses && around.share_of_misses == 1.0;
    return place_before(is_infinite ? vec4(towards_surface, 0.0)
                                    : vec4(position + around.mean_length * towards_surface, 1.0));
}

struct History {
    vec4 color;
    float age;           // frames; harmonic mean of its texels', so that a young one is not trusted for an old one's sake
    float best, worst;   // of its texels: likeness of their surfaces, 0 to 1
};

const History no_history = History(vec4(0.0), 1.0, 0.0, 0.0);

// How alike the surface is that a texel showed.
float likeness(ivec2 texel, vec3 position, vec3 plane_normal, vec3 ws_normal) {
    float device_depth = depth_before(texel);
    if (is_background(device_depth)) return 0.0;
    vec3 shown = position_before(vec2(texel) + 0.5, device_depth);
    float off_plane = abs(dot(plane_normal, shown - position)) / max(-shown.z, 1e-6);
    float cosine = dot(ws_normal, texelFetch(previous_normal, texel, 0).xyz);
    return (1.0 - smoothstep(0.0, 0.01, off_plane)) * smoothstep(0.95, 0.999, cosine);
}

History history_at(ivec2 pixel, vec2 place) {
    bool is_inside = all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, camera.extent.xy));
    if (!is_inside) return no_history;
    vec3 position = (camera.previous_view_from_world * world_position(pixel)).xyz;
    vec3 ws_normal = texelFetch(normal, pixel, 0).xyz, plane_normal = mat3(camera.previous_view_from_world) * ws_normal;
    vec2 corner = floor(place - 0.5), share = place - 0.5 - corner;
    History sum = History(vec4(0.0), 1.0, 0.0, 1.0);
    float weight_sum = 0.0, share_sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1), texel = clamped_to_screen(ivec2(corner) + side);
        float age = texelFetch(previous_age, texel, 0).r;
        float alike = age > 0.0 ? likeness(texel, position, plane_normal, ws_normal) : 0.0;
        vec2 weights = mix(1.0 - share, share, vec2(side));
        float weight = weights.x * weights.y * alike;
        sum.color += weight * texelFetch(previous_blurred, texel, 0);
        share_sum += weight / max(age, 1.0);
        sum.best = max(sum.best, alike);
        sum.worst = min(sum.worst, alike);
        weight_sum += weight;
    }
    if (weight_sum <= 0.01) return no_history;
    return History(sum.color / weight_sum, weight_sum / share_sum, sum.best, sum.worst);
}

// How far normals differ from those of the next pixels, as a sum of lengths.
float normal_change(ivec2 pixel) {
    vec3 here = texelFetch(normal, pixel, 0).xyz;
    vec3 x = texelFetch(normal, clamped_to_screen(pixel + ivec2(1, 0)), 0).xyz;
    vec3 y = texelFetch(normal, clamped_to_screen(pixel + ivec2(0, 1)), 0).xyz;
    vec3 change = abs(x - here) + abs(y - here);
    return length(change);
}

// The least of how far two neighbours of this frame were apart in the one before (pixels), at most 1: history that this
// frame stretches holds less than it seems to.
float stretch(ivec2 pixel) {
    ivec2 last = ivec2(camera.extent.xy) - 1, side = ivec2(pixel.x < last.x ? 1 : -1, pixel.y < last.y ? 1 : -1);
    vec2 here = surface_before(pixel);
    vec2 x = (surface_before(pixel + ivec2(side.x, 0)) - here) * float(side.x);
    vec2 y = (surface_before(pixel + ivec2(0, side.y)) - here) * float(side.y);
    float half_norm = 0.5 * (dot(x, x) + dot(y, y)), determinant = x.x * y.y - x.y * y.x;
    float least = half_norm - sqrt(max(half_norm * half_norm - determinant * determinant, 0.0));
    return clamp(sqrt(max(least, 0.0)), 0.0, 1.0);
}

vec4 towards_box(vec4 color, vec4 center, vec4 reach) {
    vec4 offset = color - center, ratio = abs(offset) / (reach + 1e-7);
    float farthest = max(max(ratio.x, ratio.y), max(ratio.z, ratio.w));
    return farthest > 1.0 ? center + offset / farthest : color;
}

struct Found {
    vec4 color;
    float age;  // frames, this one among them
};

Found reproject(ivec2 pixel, vec4 traced) {
    vec3 position = view_position(pixel);
    Neighborhood around = neighborhood_of(pixel);
    vec2 surface_place = surface_before(pixel);
    Place mirror_place = mirror_image_before(position, around);
    float moved = clamp(length(motion_at(pixel) * camera.extent.xy) / 128.0, 0.0, 1.0);
    History on_surface = history_at(pixel, surface_place);
    History in_mirror = mirror_place.is_known ? history_at(pixel, mirror_place.position) : no_history;

    float unit = scale_free ? max(around.mean_length, 1e-6) : 1.0;
    float scatter = max(around.length_deviation / unit, 1e-3);
    float trust = in_mirror.worst * in_mirror.best * (1.0 - min(1.0, 3.5 * scatter * min(1.0, 100.0 * moved))) *
                  (1.0 - clamp(50.0 * normal_change(pixel), 0.0, 1.0));
    bool is_known_place = around.share_of_misses < 1.0 || reproject_misses;
    float misses = reproject_misses ? 0.0 : around.share_of_misses * around.share_of_misses;
    float mirror_weight = is_known_place ? trust * (1.0 - misses) : 0.0;
    float surface_weight = (1.0 - mirror_weight) * on_surface.best;
    float weight = mirror_weight + surface_weight;
    if (weight <= 0.0) return Found(traced, 1.0);
    vec4 history = (mirror_weight * in_mirror.color + surface_weight * on_surface.color) / weight;
    float confidence = (mirror_weight * in_mirror.best + surface_weight * on_surface.best) / weight;
    float stretched = stretch(pixel);
    confidence *= stretched * stretched;

    float still = 1.0 - moved, reach = mix(0.5, 1.0, still * still);
    float scale = 1.0 + 10.0 * flicker_suppression * luminance_of(history);
    vec4 clipped = scale * color_of_ycocg(towards_box(ycocg_of(history / scale), around.mean, reach * around.deviation));
    float share = clamp_intensity * max(min(1.0, 10.0 * moved), 0.25) *
                  (1.0 + clamp((1.0 - stretched) + (1.0 - trust), 0.0, 1.0));
    float color_unit = scale_free ? max(luminance_of(history), 1e-6) : 1.0;
    float change = length(history.rgb - clipped.rgb) / color_unit;
    confidence *= exp(-30.0 * share * change) * mix(1.0, 0.95 + 0.05 * trust, clamp(100.0 * moved, 0.0, 1.0));
    if (confidence < 1e-6) return Found(traced, 1.0);
    // How old it is, the surface's history says, though the mirror's may be shown.
    return Found(max(mix(history, clipped, min(share, 1.0)), 0.0), min(on_surface.age * confidence + 1.0, max_frames));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    Found found = Found(vec4(0.0), 0.0);
    if (reflects(pixel, max_roughness)) {
        vec4 traced = traced_color(pixel);
        bool is_first_frame = camera.frame.w == 0u;
        found = Found(traced, 1.0);
        if (temporal_accumulation && !is_first_frame) found = reproject(pixel, traced);
    }
    imageStore(reprojected, pixel, found.color);
    imageStore(reprojected_age, pixel, vec4(found.age));
}
