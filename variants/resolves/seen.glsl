// What a pixel's ray sees. Needs the parameters of ray_draw.h, misses and previous_frame.
#ifndef RESOLVES_SEEN_GLSL
#define RESOLVES_SEEN_GLSL
#include "common/mirror_ray.glsl"
#include "core/shaders/gbuffer/environment.glsl"
#include "resolves/hit_color.glsl"
#include "resolves/ray.glsl"

uniform sampler2D hit_color;

struct Seen {
    vec3 radiance;
    float confidence;  // share of it that is known
};

// Of a ray into its own surface it is known that it brings no light, as in the path-traced reference.
Seen seen_by(ivec2 pixel, TracedRay ray) {
    const bool misses_see_environment = misses == 1u;
    if (ray.target == ray_into_surface) return Seen(vec3(0.0), 1.0);
    vec3 hit = vec3(0.0);
    float confidence = 0.0;
    if (is_hit(ray)) {
        vec2 uv = color_uv_of(pixel_of_target(ray.target));
        confidence = lies_on_image(uv) ? ray.confidence : 0.0;
        hit = textureLod(hit_color, uv, 0.0).rgb;
    }
    if (!misses_see_environment) return Seen(hit, confidence);
    return Seen(mix(environment_along_ray(pixel, mat3(camera.world_from_view) * ray.direction), hit, confidence), 1.0);
}
#endif
