// Blends each pixel's reflection with its history, which counts less the faster the surface or the reflected object
// moves.
#include "denoisers/reflector_history.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D gathered, target_motion, previous_age;
uniform writeonly image2D accumulated, age, reflections;

bool counts_surface() { return speed_of != 2u; }
bool counts_target() { return speed_of != 1u; }

// Share of history that a way on the screen (uv per frame) rejects.
float rejected_on_screen(vec2 of_surface, vec2 of_target) {
    bool is_legacy = rejection == 1u;
    const float legacy_factor = 128.0;
    const float default_rejection = 0.5, default_scale = 0.2;  // by which HDRP divides the factor
    float factor = is_legacy ? legacy_factor : legacy_factor / (default_rejection * default_scale) * speed_rejection;
    float speed = (counts_surface() ? length(of_surface) : 0.0) + (counts_target() ? length(of_target) : 0.0);
    return clamp(factor * speed, 0.0, 1.0);
}

// Half of the way across the view (m), as in HDRP, which takes uv for clip coordinates; it grows beyond bounds towards
// the far plane, as there. With orthographic cameras, where HDRP divides by 0, it is the same at every distance.
vec2 way_in_view(vec2 moved, float camera_distance) {
    vec2 half_view = 1.0 / abs(vec2(camera.clip_from_view[0][0], camera.clip_from_view[1][1]));
    bool is_orthographic = camera.frame.z == 1u;
    if (is_orthographic) return moved * half_view;
    float near_far_plane = max(1.0 - camera_distance / camera.depth.y, 1e-6);
    return moved * half_view * camera_distance / near_far_plane;
}

// The same in space.
float rejected_in_world(vec2 of_surface, vec2 of_target) {
    bool is_hard = rejection == 2u;
    float largest = 0.1 * world_speed_scale;
    float speed = add_speeds ? length(of_surface) + length(of_target) : length(of_surface + of_target);
    float share = clamp(speed / (largest * largest), 0.0, 1.0);
    return is_hard ? float(share >= 1.0 - speed_rejection) : clamp(share * speed_rejection, 0.0, 1.0);
}

float rejected(ivec2 pixel) {
    vec3 of_target = texelFetch(target_motion, pixel, 0).xyz;
    vec2 of_surface = motion_at(pixel);
    bool is_in_world = rejection >= 2u;
    if (!is_in_world) return rejected_on_screen(of_surface, of_target.xy);
    float camera_distance = -view_z(texelFetch(depth, pixel, 0).r);
    return rejected_in_world(counts_surface() ? way_in_view(of_surface, camera_distance) : vec2(0.0),
                             counts_target() ? way_in_view(of_target.xy, of_target.z) : vec2(0.0));
}

struct Accumulated {
    vec4 color;  // as texels of previous_accumulated
    float age;   // frames that it holds
};

Accumulated history_of(ivec2 pixel) {
    ivec2 texel = pixel;
    History history = History(max(texelFetch(previous_accumulated, pixel, 0), vec4(0.0)), true);
    if (reproject_history) {
        Place place = Place(surface_before(pixel), true);
        history = history_at(pixel, place);
        texel = ivec2(place.position);
    }
    return Accumulated(history.color, history.is_found ? texelFetch(previous_age, texel, 0).r : 0.0);
}

Accumulated blended(ivec2 pixel, vec4 color) {
    const uint first_frames = 3u;  // of which HDRP keeps the last one
    bool is_first_frame = camera.frame.w == 0u || (!average_evenly && camera.frame.x < first_frames);
    if (is_first_frame) return Accumulated(color, 1.0);
    Accumulated history = history_of(pixel);
    if (reproject_history && history.age == 0.0) return Accumulated(color, 1.0);
    float of_history = 1.0 - rejected(pixel);
    if (isnan(of_history)) of_history = 0.0;  // of faulty motion vectors
    float frames = 1.0 + of_history * history.age;
    float share = mix(1.0, exp2(-7.0 * accumulation), of_history);
    if (average_evenly) share = max(share, 1.0 / frames);
    return Accumulated(mix(history.color, color, share), frames);
}

bool is_color(vec4 color) { return !any(isnan(color)) && !any(isinf(color)); }

// Radiance, confidence.
vec4 without_confidence(vec4 color) {
    const float least_confidence = 1e-6;  // of what has faded that much, denormals lose the colour
    if (color.a <= least_confidence) return vec4(0.0);
    const float largest = 3.4e38;  // two sums that are rounded differently may divide to more than a float holds
    return vec4(min(color.rgb / color.a, vec3(largest)), min(color.a, 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    Accumulated result = Accumulated(no_reflection, 0.0);
    if (reflects(pixel, max_roughness)) {
        result = Accumulated(texelFetch(gathered, pixel, 0), 1.0);
        if (temporal_accumulation) result = blended(pixel, result.color);
        if (!is_color(result.color)) result.color = vec4(0.0);  // of sums that overflow
    }
    imageStore(accumulated, pixel, result.color);
    imageStore(age, pixel, vec4(result.age));
    imageStore(reflections, pixel, without_confidence(result.color));
}
