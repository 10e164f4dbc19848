// Blends each pixel with the previous frame's result ("Temporal Accumulation").
#include "common/mirror_ray.glsl"
#include "common/motion.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D traced, reflection_way, previous_blended, previous_depth;
uniform writeonly image2D blended;

const uint place_by_camera = 0u, place_of_reflection = 2u;  // parameter `history_place`

// What is blended: colour and confidence, or their product and confidence.
vec4 weighed(vec4 color) { return weigh_by_confidence ? vec4(color.rgb * color.a, color.a) : color; }
vec4 unweighed(vec4 color) {
    return !weigh_by_confidence ? color : color.a > 0.0 ? vec4(color.rgb / color.a, color.a) : vec4(0.0);
}

vec4 neighbor(ivec2 pixel) {
    return weighed(texelFetch(traced, clamp(pixel, ivec2(0), ivec2(camera.extent.xy) - 1), 0));
}

vec4 clamped_to_neighborhood(ivec2 pixel, vec4 history) {
    vec4 low = neighbor(pixel), high = low;
    for (int i = 0; i < 9; ++i) {
        vec4 color = neighbor(pixel + ivec2(i % 3, i / 3) - 1);
        low = min(low, color);
        high = max(high, color);
    }
    return clamp(history, low, high);
}

// What moves past leaves its history at neighbours that do not show it any more: the longest way among them counts.
float longest_way(ivec2 pixel) {
    float longest = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), ivec2(camera.extent.xy) - 1);
        longest = max(longest, length(texelFetch(reflection_way, at, 0).xy));
    }
    return longest;
}

struct Before {
    vec2 uv;           // un-jittered screen of the frame before
    float way;         // from there to here, as `motion_threshold` counts it
    float view_depth;  // distance from that camera's plane (m)
    bool is_in_front;
};

Before surface_before(ivec2 pixel, float device_depth) {
    vec2 uv = screen_from_pixel(pixel) * camera.extent.zw;
    vec4 world = vec4(world_from_screen(uv, device_depth), 1.0);
    vec4 clip = camera.previous_clip_from_world * world;
    vec2 by_camera = clip.xy / clip.w * 0.5 + 0.5;
    vec2 found = by_camera;
    float way = 0.0;
    if (history_place == place_of_reflection) {
        found = uv - texelFetch(reflection_way, pixel, 0).xy;
        way = longest_way(pixel);
    } else {
        if (history_place != place_by_camera) found = uv - motion_at(pixel);
        way = length(found - uv);
    }
    return Before(found, way, -(camera.previous_view_from_world * world).z, clip.w > 0.0);
}

bool shows_the_same(Before before) {
    ivec2 texel = ivec2(floor(before.uv * camera.extent.xy - camera.jitter.zw));
    float device_depth = texelFetch(previous_depth, clamp(texel, ivec2(0), ivec2(camera.extent.xy) - 1), 0).r;
    vec4 view = camera.previous_view_from_clip * vec4(before.uv * 2.0 - 1.0, device_depth, 1.0);
    return !is_background(device_depth) && abs(-view.z / view.w - before.view_depth) <= 0.01 * before.view_depth;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 current = texelFetch(traced, pixel, 0), result = current;
    float device_depth = texelFetch(depth, pixel, 0).r;
    if (camera.frame.w == 1u && !is_background(device_depth)) {
        Before before = surface_before(pixel, device_depth);
        bool is_usable = before.is_in_front && all(greaterThanEqual(before.uv, vec2(0.0))) &&
                         all(lessThanEqual(before.uv, vec2(1.0))) && !(reject_other_surfaces && !shows_the_same(before));
        if (is_usable) {
            vec4 history = weighed(textureLod(previous_blended, before.uv - camera.jitter.zw * camera.extent.zw, 0.0));
            if (neighborhood_clamp) history = clamped_to_neighborhood(pixel, history);
            float rejection = 1.0 - clamp(before.way / motion_threshold, 0.0, 1.0);
            result = unweighed(mix(weighed(current), history, temporal_blend * rejection));
        }
    }
    imageStore(blended, pixel, result);
}
