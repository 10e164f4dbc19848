#ifndef DENOISERS_SOLID_ANGLE_GLSL
#define DENOISERS_SOLID_ANGLE_GLSL

// By which the solid angle of an area around a hit shrinks from one origin to another: dA = d^2 dw / |cos|, of the same
// area for both. `length_ratio`: of the way from the first over that from the second; all vectors unit.
float solid_angle_ratio(vec3 hit_normal, vec3 from_direction, vec3 to_direction, float length_ratio) {
    const float least_cosine = 1e-3;  // a pixel's normal says no more about surfaces seen edge-on
    float from = max(abs(dot(hit_normal, from_direction)), least_cosine);
    float to = max(abs(dot(hit_normal, to_direction)), least_cosine);
    return length_ratio * length_ratio * to / from;
}
#endif
