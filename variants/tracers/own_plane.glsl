#ifndef TRACERS_OWN_PLANE_GLSL
#define TRACERS_OWN_PLANE_GLSL

// Whether a sample is of the plane that a ray leaves, and so not what it meets: it lies less than half as high above it
// as the ray does. Samples are steps, and at grazing angles the next step of that plane lies in the ray's way.
// `from_origin`: of the ray to the sample (m). `rise`: m off the plane per m along the ray. `distance`: along it (m).
bool is_own_plane(vec3 from_origin, vec3 normal, float rise, float distance) {
    return dot(from_origin, normal) < 0.5 * rise * distance;
}
#endif
