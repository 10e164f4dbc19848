// Whose rays a pixel has.
#ifndef RATIO_FILTER_TAPS_GLSL
#define RATIO_FILTER_TAPS_GLSL
#include "denoisers/ratio_filter/kernel.glsl"
#include "denoisers/ray.glsl"

uint spatial_tap_count(float roughness) {
    uint count = 1u + uint(float(max_taps - 1u) * width_share(roughness) + 0.5);
    return half_resolution ? max(count, 5u) : count;
}

// Traced pixels, as a screen has y down. Lobes are seen longer along the direction in which the normal leans.
ivec2 disk_offset(uint i, uint n, float random, float roughness, vec3 vs_normal) {
    float least = half_resolution ? 1.5 : 0.0, most = max(0.875 * disk_radius, least);
    float radius = disk_radius * sqrt(width_share(roughness));
    float narrowing = 1.0 - 0.5 * clamp(min(12.0 * roughness, 2.0 - 5.0 * roughness), 0.0, 1.0);
    vec2 radii = clamp(radius * vec2(1.0, narrowing), least, most);
    vec2 lean = vec2(vs_normal.x, -vs_normal.y);
    lean = dot(lean, lean) > 1e-12 ? normalize(lean) : vec2(1.0, 0.0);
    vec2 point = hammersley(i, n);
    float turns = fract(point.y * (1.0 - random / float(n)) + 0.5);
    vec2 on_disk = sqrt(point.x) * radii * unit_circle(turns);
    return ivec2(round(on_disk.x * lean + on_disk.y * vec2(-lean.y, lean.x)));
}

ivec2 tap_offset(uint tap, uint count, vec2 random, float roughness, vec3 vs_normal) {
    const bool is_disk = kernel == 0u;
    if (is_disk) return disk_offset(tap, count, random.x, roughness, vs_normal);
    float width = box_width * sqrt(width_share(roughness));
    return box_offset(tap, count, random, half_resolution ? max(width, 3.0) : width);
}

// A pixel between traced ones takes the nearer one more often, each axis by itself.
ivec2 nearest_traced(ivec2 pixel) {
    if (!half_resolution || !stochastic_upsampling) return traced_of_pixel(pixel);
    vec2 place = 0.5 * vec2(pixel - quad_pixel(camera.frame.x + first_turn(camera.frame.y)));
    bvec2 takes_next = greaterThan(fract(place), random_pair(pixel, 0u, upsampling_dimension));
    return clamp(ivec2(floor(place)) + ivec2(takes_next), ivec2(0), traced_extent() - 1);
}
#endif
