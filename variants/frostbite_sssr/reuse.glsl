// A traced ray as seen by the pixels that reuse it.
#ifndef FROSTBITE_SSSR_REUSE_GLSL
#define FROSTBITE_SSSR_REUSE_GLSL
#include "frostbite_sssr/previous_view.glsl"
#include "denoisers/aimed_ray.glsl"
#include "denoisers/hit_color.glsl"
#include "denoisers/ray.glsl"
#include "denoisers/solid_angle.glsl"
#include "frostbite_sssr/surface.glsl"

// All of a ray that does not depend on who resolves it. View space.
struct ReusedRay {
    TracedRay traced;
    vec3 origin, hit_normal;
    vec2 color_uv;  // of the hit in the image that it takes its colour from
    bool is_dropped;
};

ReusedRay reused_ray(vec3 origin, TracedRay traced) {
    const bool hidden_hits_show = hidden_hits == 0u, hidden_hits_are_dropped = hidden_hits == 2u;
    ReusedRay ray = ReusedRay(traced, origin, vec3(0.0), vec2(0.0), false);
    if (!is_hit(traced)) return ray;
    ivec2 pixel = pixel_of_target(traced.target);
    if (reuse_jacobian) ray.hit_normal = view_geometric_normal(pixel);
    ray.color_uv = color_uv_of(pixel);
    bool had_left_screen = !lies_on_image(ray.color_uv);
    bool is_asked = previous_frame && !hidden_hits_show && !had_left_screen;
    bool was_hidden = is_asked && !was_seen(pixel, ray.color_uv * camera.extent.xy);
    if (had_left_screen || was_hidden) ray.traced.confidence = 0.0;
    ray.is_dropped = was_hidden && hidden_hits_are_dropped;
    return ray;
}

// A ray as if the pixel had traced it.
struct OwnRay {
    vec3 direction;         // view space, unit
    float inverse_density;  // of that direction (sr)
    float ray_length;       // m; 0: nothing was hit
};

OwnRay as_own_ray(Surface surface, ReusedRay ray) {
    OwnRay own = OwnRay(ray.traced.direction, ray.traced.inverse_density, 0.0);
    if (!is_hit(ray.traced)) return own;
    own.ray_length = ray.traced.ray_length;
    bool is_reaimed = neighbor_ray == 0u;
    if (!is_reaimed) return own;
    AimedRay aimed = aimed_at_hit(ray.origin - surface.position, ray.traced);
    if (aimed.ray_length == 0.0) return own;
    own.direction = aimed.direction;
    own.ray_length = aimed.ray_length;
    float length_ratio = ray.traced.ray_length / own.ray_length;
    if (reuse_jacobian)
        own.inverse_density *= solid_angle_ratio(ray.hit_normal, ray.traced.direction, own.direction, length_ratio);
    return own;
}
#endif
