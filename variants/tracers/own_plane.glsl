#ifndef TRACERS_OWN_PLANE_GLSL
#define TRACERS_OWN_PLANE_GLSL
#include "tracers/trace.glsl"

// Whether a sample is of the plane that a ray leaves, and so not what it meets: it lies less than half as high above it
// as the ray does. Samples are steps, and at grazing angles the next step of that plane lies in the ray's way.
// `from_origin`: of the ray to the sample (m). `rise`: m off the plane per m along the ray. `distance`: along it (m).
bool is_own_plane(vec3 from_origin, vec3 normal, float rise, float distance) {
    return dot(from_origin, normal) < 0.5 * rise * distance;
}

// The same of what `pixel` shows at the device depth `surface`, for a ray that passes it at `distance` (m); the pixel
// that the ray starts from is its own in any case.
bool is_own_surface(TraceRay ray, ivec2 pixel, float surface, float distance) {
    vec3 from_origin = view_position_at(pixel, surface) - ray.origin;
    return pixel == ray.pixel || is_own_plane(from_origin, ray.geometric_normal,
                                              dot(ray.direction, ray.geometric_normal), distance);
}
#endif
