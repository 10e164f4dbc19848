// What was reflected at a pixel in the frame before.
#ifndef FROSTBITE_SSSR_HISTORY_GLSL
#define FROSTBITE_SSSR_HISTORY_GLSL
#include "common/motion.glsl"
#include "frostbite_sssr/previous_view.glsl"

// Texels of previous_accumulated: colour times confidence, confidence; the latter negative where nothing reflected.
uniform sampler2D previous_accumulated, previous_normal;

const vec4 no_reflection = vec4(0.0, 0.0, 0.0, -1.0);

// Where on the previous frame's images a point of its screen is, both in pixels.
vec2 image_position(vec2 uv) { return uv * camera.extent.xy - camera.jitter.zw; }

vec2 surface_before(ivec2 pixel) {
    return image_position(screen_from_pixel(pixel) * camera.extent.zw - motion_at(pixel));
}

struct Place {
    vec2 position;
    bool is_known;
};

// What a plane mirrors seems to stand behind it, as far as it is away, and to stay there while the camera moves. A ray
// length of 0 stands for infinity.
Place mirror_image_before(ivec2 pixel, float ray_length) {
    vec3 position = view_position(pixel), towards_surface = view_direction(position);
    vec4 image = ray_length > 0.0 ? vec4(position + ray_length * towards_surface, 1.0) : vec4(towards_surface, 0.0);
    vec4 clip = camera.previous_clip_from_world * (camera.world_from_view * image);
    return Place(image_position(clip.xy / clip.w * 0.5 + 0.5), clip.w > 0.0);
}

// Rays that meet nothing on the screen show the environment, if anything. To an orthographic camera a plane mirrors the
// same part of it everywhere, so that any place of the plane will do.
Place reflection_before(ivec2 pixel, float ray_length) {
    const bool misses_show_nothing = misses == 0u;
    bool is_orthographic = camera.frame.z == 1u;
    if (ray_length == 0.0 && (misses_show_nothing || is_orthographic)) return Place(surface_before(pixel), true);
    return mirror_image_before(pixel, ray_length);
}

// As the previous camera would see it: positions and the geometric normal in its view space, the shading normal in world
// space.
struct Reflector {
    vec3 position, geometric_normal, ws_normal;
    float roughness;
};

Reflector reflector_at(ivec2 pixel) {
    vec4 normal_roughness = texelFetch(normal, pixel, 0);
    return Reflector((camera.previous_view_from_world * world_position(pixel)).xyz, geometric_normal_before(pixel),
                     normal_roughness.xyz, normal_roughness.w);
}

// Whether the texel showed the same plane as rough as now; one that moved has its mirror image elsewhere. The limits are
// ours: 26 degrees, a tenth in perceptual roughness.
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
