// The most that one layer of depth contains. Every pixel that the ray crosses is tested; it shows the plane through its
// sample with its geometric normal, not a step. Speed is no goal.
#ifndef TRACERS_EXACT_LAYER_GLSL
#define TRACERS_EXACT_LAYER_GLSL
#include "tracers/screen_cells.glsl"

const uint exact_layer_thickness_of_scene = 1u;  // parameter `thickness_from`

#ifdef TRACER_HAS_DEPTH_LAYERS
uniform sampler2D back_depth;
#endif

// What a pixel shows.
struct ExactLayerPatch {
    vec3 position, normal;  // view space
    float device_depth;
};

ExactLayerPatch exact_layer_patch(ivec2 pixel) {
    float device_depth = fetch_depth(pixel);
    vec3 position = view_from_screen(screen_from_pixel(pixel) * camera.extent.zw, device_depth);
    return ExactLayerPatch(position, view_geometric_normal(pixel), device_depth);
}

// Width of a pixel at a distance from the camera plane (m).
float exact_layer_pixel_width(float z) {
    float scale = abs(camera.clip_from_view[1][1]) * camera.extent.y * 0.5;
    return (camera.frame.z == 1u ? 1.0 : -z) / scale;
}

// How far what the pixel shows reaches away from the camera (view-space z, negative).
float exact_layer_solid_end(ivec2 pixel, ExactLayerPatch patch_of_pixel) {
#ifdef TRACER_HAS_DEPTH_LAYERS
    if (exact_layer_thickness_from == exact_layer_thickness_of_scene) {
        count_fetch();
        return view_z(texelFetch(back_depth, pixel, 0).r);
    }
#endif
    return patch_of_pixel.position.z * (1.0 + exact_layer_relative_thickness);
}

// Whether the surface of a pixel may reach as far as a depth (view-space z): a plane that is seen nearly from its edge
// spans any depth within a pixel. Beyond two pixels' widths it reaches as far as a neighbour of the same plane does.
bool exact_layer_reaches(ivec2 pixel, ExactLayerPatch shown, float z) {
    float off = abs(z - shown.position.z), width = exact_layer_pixel_width(shown.position.z);
    if (off <= 2.0 * width) return true;
    for (int i = 0; i < 4; ++i) {
        ivec2 neighbour = pixel + (i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5));
        if (!is_on_screen(neighbour)) continue;
        ExactLayerPatch beside = exact_layer_patch(neighbour);
        if (is_background(beside.device_depth)) continue;
        bool is_same_plane = abs(dot(beside.position - shown.position, shown.normal)) <= width;
        if (is_same_plane && off <= abs(beside.position.z - shown.position.z)) return true;
    }
    return false;
}

// At grazing angles rounding puts samples of the plane that the ray leaves in its way.
bool exact_layer_is_own(ScreenLine line, ExactLayerPatch shown, float distance) {
    return is_own_plane(shown.position - line.vs_origin, line.vs_normal, line.rise, distance);
}

TraceEnd exact_layer_hit(ScreenLine line, ivec2 pixel, float distance) {
    return TraceEnd(pixel, position_at(line, t_of_distance(line, distance)), distance, 1.0, outcome_hit);
}

TraceEnd exact_layer_trace(TraceRay ray) {
    ScreenLine line = screen_line(ray);
    CellExit here = exit_of_cell(line, line.pixel, 0);  // not its own pixel
    while (here.t < line.end) {
        CellExit ahead = exit_of_cell(line, here.pixel, 0);
        ivec2 pixel = here.pixel;
        float t_in = here.t, t_out = min(ahead.t, line.end);
        here = ahead;
        ExactLayerPatch shown = exact_layer_patch(pixel);
        if (is_background(shown.device_depth)) continue;

        float s_in = distance_at(line, t_in), s_out = distance_at(line, t_out);
        vec3 p_in = ray.origin + s_in * ray.direction, p_out = ray.origin + s_out * ray.direction;
        float height_in = dot(p_in - shown.position, shown.normal), height_out = dot(p_out - shown.position, shown.normal);
        if (height_in >= 0.0) {
            if (height_out >= 0.0) continue;
            float share = height_in / (height_in - height_out);
            float distance = mix(s_in, s_out, share);
            if (exact_layer_is_own(line, shown, distance)) continue;
            if (!exact_layer_reaches(pixel, shown, mix(p_in.z, p_out.z, share))) continue;
            return exact_layer_hit(line, pixel, distance);
        }
        if (exact_layer_is_own(line, shown, s_in)) continue;
        // Behind the plane at once. Planes of neighbours on a curved surface do not join: less than a pixel's width is a
        // crack between them.
        bool is_in_crack = height_in > -exact_layer_pixel_width(p_in.z) && dot(ray.direction, shown.normal) < 0.0;
        if (is_in_crack && exact_layer_reaches(pixel, shown, p_in.z)) return exact_layer_hit(line, pixel, s_in);
        float z_near = max(p_in.z, p_out.z), z_far = min(p_in.z, p_out.z);
        float solid_end = exact_layer_solid_end(pixel, shown);
        bool is_inside = solid_end < shown.position.z && z_far < shown.position.z && z_near > solid_end;
        if (!is_inside) continue;
        // What is known to be solid was entered where the screen does not show it; what is only taken to be solid is met.
        if (exact_layer_thickness_from == exact_layer_thickness_of_scene)
            return missed(outcome_hidden, position_at(line, t_in), s_in);
        if (dot(ray.direction, shown.normal) >= 0.0) return missed(outcome_from_behind, position_at(line, t_in), s_in);
        return exact_layer_hit(line, pixel, s_in);
    }
    return missed_on_line(line, false);
}
#endif
