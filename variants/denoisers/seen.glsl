// What a pixel's ray sees. Needs the parameters of ray_draw.json, misses and previous_frame.
#ifndef DENOISERS_SEEN_GLSL
#define DENOISERS_SEEN_GLSL
#include "common/mirror_ray.glsl"
#include "common/screen_probe/lookup.glsl"
#include "core/shaders/gbuffer/environment.glsl"
#include "denoisers/hit_color.glsl"
#include "denoisers/ray.glsl"

uniform sampler2D hit_color;

// What a ray of the pixel may see beyond the screen; `direction`: world space, unit.
vec3 guessed_along_ray(ivec2 pixel, vec3 direction) {
    vec4 surfaces = surfaces_along((camera.world_from_view * vec4(view_position(pixel), 0.0)).xyz, direction);
    return surfaces.rgb + (1.0 - surfaces.a) * environment_along_ray(pixel, direction);
}

struct Seen {
    vec3 radiance;
    float confidence;  // share of it that is known
};

// Of a ray into its own surface it is known that it brings no light, as in the path-traced reference.
Seen seen_by(ivec2 pixel, TracedRay ray) {
    const bool misses_are_known = misses != 0u, misses_are_guessed = misses == 2u;
    if (ray.target == ray_into_surface) return Seen(vec3(0.0), 1.0);
    vec3 hit = vec3(0.0);
    float confidence = 0.0;
    if (is_hit(ray)) {
        vec2 uv = color_uv_of(pixel_of_target(ray.target));
        confidence = lies_on_image(uv) ? ray.confidence : 0.0;
        hit = textureLod(hit_color, uv, 0.0).rgb;
    }
    if (!misses_are_known) return Seen(hit, confidence);
    if (misses_are_guessed && confidence == 1.0) return Seen(hit, 1.0);  // most rays, which need no guess
    vec3 ws_direction = mat3(camera.world_from_view) * ray.direction;
    vec3 beyond = misses_are_guessed ? guessed_along_ray(pixel, ws_direction) : environment_along_ray(pixel, ws_direction);
    return Seen(mix(beyond, hit, confidence), 1.0);
}
#endif
