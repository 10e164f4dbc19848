// Where a pixel's reflection was in the previous frame. Needs the parameter misses.
#ifndef FROSTBITE_SSSR_HISTORY_GLSL
#define FROSTBITE_SSSR_HISTORY_GLSL
#include "denoisers/reflector_history.glsl"

// What a plane mirrors seems to stand behind it, as far as it is away, and to stay there while the camera moves. A ray
// length of 0 stands for infinity.
Place mirror_image_before(ivec2 pixel, float ray_length) {
    vec3 position = view_position(pixel), towards_surface = view_direction(position);
    return place_before(ray_length > 0.0 ? vec4(position + ray_length * towards_surface, 1.0)
                                         : vec4(towards_surface, 0.0));
}

// Rays that meet nothing on the screen show the environment, if anything. To an orthographic camera a plane mirrors the
// same part of it everywhere, so that any place of the plane will do.
Place reflection_before(ivec2 pixel, float ray_length) {
    const bool misses_show_nothing = misses == 0u;
    bool is_orthographic = camera.frame.z == 1u;
    if (ray_length == 0.0 && (misses_show_nothing || is_orthographic)) return Place(surface_before(pixel), true);
    return mirror_image_before(pixel, ray_length);
}
#endif
