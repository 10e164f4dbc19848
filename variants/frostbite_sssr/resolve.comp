// Combines each pixel's own and neighbouring rays.
#include "frostbite_sssr/estimators.glsl"
#include "frostbite_sssr/taps.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D resolved_radiance, resolved_length;

struct Group {
    ivec2 pixel[max_group_size];
    bool is_resolved[max_group_size];
    Surface surface[max_group_size];
    Sums sums[max_group_size];
};

Group group_at(ivec2 first_pixel) {
    Group group;
    for (int n = 0; n < group_size; ++n) {
        ivec2 pixel = pixel_of_group(first_pixel, n);
        group.pixel[n] = pixel;
        group.is_resolved[n] = is_on_screen(pixel) && reflects(pixel, max_roughness);
        if (!group.is_resolved[n]) continue;
        group.surface[n] = surface_of(pixel);
        group.sums[n] = no_sums;
        if (group.surface[n].o.z <= 0.0) group.is_resolved[n] = false;  // the compositor shows no such reflections
    }
    return group;
}

void add_rays_of(ivec2 traced, inout Group group) {
    vec3 origin = view_position(traced_pixel(traced, camera.frame.x));
    for (uint k = 0u; k < max_rays; ++k) {
        TracedRay traced_ray = load_ray(index_of_ray(traced, k));
        if (traced_ray.inverse_density == 0.0) continue;
        ReusedRay ray = reused_ray(origin, traced_ray);
        if (ray.is_dropped) continue;
        for (int n = 0; n < group_size; ++n)
            if (group.is_resolved[n]) add_ray(group.sums[n], group.pixel[n], group.surface[n], ray);
    }
}

// Taps that the border moves on top of each other, or rounding, count once.
void add_taps(ivec2 first_pixel, inout Group group) {
    bool is_any_resolved = false;
    for (int n = 0; n < group_size; ++n) is_any_resolved = is_any_resolved || group.is_resolved[n];
    int count = is_any_resolved ? tap_count : 0;
    ivec2 visited[max_tap_count];
    for (int tap = 0; tap < count; ++tap) {
        visited[tap] = tap_position(first_pixel, tap);
        bool is_new = true;
        for (int earlier = 0; earlier < tap; ++earlier) is_new = is_new && visited[earlier] != visited[tap];
        if (is_new) add_rays_of(visited[tap], group);
    }
}

void main() {
    ivec2 first_pixel = first_pixel_of(ivec2(gl_GlobalInvocationID.xy));
    Group group = group_at(first_pixel);
    add_taps(first_pixel, group);
    for (int n = 0; n < group_size; ++n) {
        if (!is_on_screen(group.pixel[n])) continue;
        bool is_resolved = group.is_resolved[n];
        vec4 result = is_resolved ? resolved(group.sums[n], group.surface[n]) : vec4(0.0);
        imageStore(resolved_radiance, group.pixel[n], result);
        imageStore(resolved_length, group.pixel[n], vec4(is_resolved ? length_of(group.sums[n]) : 0.0));
    }
}
