// Blurs history and rays by the same eight neighbours and blends them. The result is the next frame's history and is
// blurred again, by a disk that shrinks with age.
#include "denoisers/lobe_disk.glsl"
#include "denoisers/pixel_scale.glsl"
#include "denoisers/recurrent_blur/ray_statistics.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D reprojected, reprojected_age;
uniform writeonly image2D blurred, age, reflections;

const int tap_count = 8;
const float miss_length = 0.25;  // m, or with scale_free of the distance: what a ray without a hit counts as

// Of a pixel and the four next to it.
struct Cross {
    float ray_length;  // harmonic mean (m)
    bool has_miss;
    float variation;   // standard deviation of the luminance over its mean
};

Cross cross_of(ivec2 pixel, float camera_distance) {
    const ivec2 arms[5] = ivec2[5](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    Cross result = Cross(0.0, false, 0.0);
    vec2 lengths = vec2(0.0), luminances = vec2(0.0);
    for (int i = 0; i < 5; ++i) {
        ivec2 neighbor = clamped_to_screen(pixel + arms[i]);
        if (!reflects(neighbor, max_roughness)) neighbor = pixel;
        float ray_length = texelFetch(own_length, neighbor, 0).r;
        if (ray_length == 0.0) {
            result.has_miss = true;
            ray_length = miss_length * (scale_free ? camera_distance : 1.0);
        }
        lengths += vec2(ray_length, 1.0) / (ray_length + 0.001);
        float luminance = luminance_of(traced_color(neighbor));
        luminances += vec2(luminance, luminance * luminance) / 5.0;
    }
    result.ray_length = lengths.x / lengths.y;
    result.variation = sqrt(max(luminances.y - luminances.x * luminances.x, 0.0)) / max(luminances.x, 1e-4);
    return result;
}

// What a pixel is, as its neighbours are compared with it. View space.
struct Receiver {
    vec3 position, normal;
    float camera_distance, roughness, aggressivity, hit_share, cone_angle;
    bool has_miss;
};

// A length over the height of the view at a position.
float share_of_view(float ray_length, vec3 position) {
    return clamp(ray_length * pixels_per_metre(position) * camera.extent.w, 0.0, 1.0);
}

// Half the angle (rad) within which neighbours' normals count.
float cone_of_normals(float roughness, float aggressivity) {
    const float encoding_error = 1.5 / 255.0;
    float open = (1.0 - normal_phi) * (1.0 - normal_phi) * (1.0 - sqrt(aggressivity));
    float share = clamp(open, 0.1, 0.99);
    return max(atan(roughness * roughness * sqrt(share / (1.0 - share))), encoding_error);
}

Receiver receiver_at(ivec2 pixel, float frames, Cross around) {
    Receiver receiver;
    receiver.position = view_position(pixel);
    receiver.normal = view_normal(pixel);
    receiver.camera_distance = abs(receiver.position.z);
    receiver.roughness = texelFetch(normal, pixel, 0).w;
    receiver.aggressivity = 1.0 - max(pow(frames, strength - 1.0), 0.05);
    receiver.hit_share = share_of_view(around.ray_length, receiver.position);
    receiver.cone_angle = cone_of_normals(receiver.roughness, receiver.aggressivity);
    receiver.has_miss = around.has_miss;
    return receiver;
}

// m. Ray lengths and distances as they are, or with scale_free in proportion to the length alone, as lobes widen.
float disk_radius(Receiver receiver, Cross around) {
    float distance = scale_free ? 1.0 : receiver.camera_distance;
    return 0.1 * radius * around.ray_length * distance * max(sqrt(receiver.roughness), 0.01) *
           (1.0 - 0.999 * receiver.aggressivity);
}

// The axes of the disk, which faces the rays; shorter across the view where it grazes.
mat2x3 disk_axes(Receiver receiver) {
    vec3 view = view_direction(receiver.position);
    vec3 axis = normalize(mix(receiver.normal, reflect(view, receiver.normal), 1.0 - receiver.roughness));
    mat2x3 axes = disk_towards(axis, receiver.normal);
    float grazing = acos(clamp(abs(receiver.normal.z), 0.0, 1.0)) / (0.5 * pi);
    axes[0] *= mix(1.0, receiver.roughness, grazing);
    return axes;
}

float neighbor_weight(Receiver receiver, vec4 own, ivec2 neighbor) {
    vec3 position = view_position(neighbor);
    float cosine = dot(receiver.normal, view_normal(neighbor));
    float by_normal = exp((cosine - 1.0) * 8.0 / (receiver.cone_angle * receiver.cone_angle));
    float off_plane = abs(dot(receiver.normal, receiver.position - position)) / receiver.camera_distance;
    float by_plane = off_plane * 500.0 * depth_phi * abs(receiver.normal.z);

    vec4 color = traced_color(neighbor);
    float color_unit = scale_free ? max(max(luminance_of(own), luminance_of(color)), 1e-6) : 1.0;
    float by_luminance = 10.0 * luma_phi * abs(luminance_of(color) - luminance_of(own)) / color_unit;
    float ray_length = texelFetch(own_length, neighbor, 0).r;
    bool is_miss = ray_length == 0.0;
    float hit_share = is_miss ? 1.0 : share_of_view(ray_length, position);
    float length_unit = scale_free ? 1.0 : receiver.camera_distance;
    float by_length = is_miss && receiver.has_miss ? 1.0
                                                   : length_phi * abs(receiver.hit_share - hit_share) / length_unit;
    float by_roughness = roughness_phi * abs(receiver.roughness - texelFetch(normal, neighbor, 0).w);
    return exp(-(receiver.aggressivity * (by_luminance + by_length + by_roughness) + by_plane)) * by_normal;
}

struct Sums {
    vec4 history, traced;
    float weight, age, age_weight;
};

float firefly_factor(vec4 color, float frames) {
    float luminance = luminance_of(color);
    return damp_fireflies ? mix(1.0 / (luminance * luminance + 0.01), 1.0, min(frames / 5.0, 1.0)) : 1.0;
}

Sums blurred_at(ivec2 pixel, float frames, Cross around) {
    vec4 own = traced_color(pixel);
    Sums sums = Sums(texelFetch(reprojected, pixel, 0), own, 1.0, frames, 1.0);
    if (!spatial_filter) return sums;
    Receiver receiver = receiver_at(pixel, frames, around);
    mat2x3 axes = disk_radius(receiver, around) * disk_axes(receiver);
    float angle = rotation_of(pixel), shrink = 1.0;
    mat2 rotation = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec2 pull = vec2(0.0);
    for (int i = 0; i < tap_count; ++i) {
        float turn = (float(i) + 0.5) * golden_angle;
        vec2 even = vec2(cos(turn), sin(turn)), direction = even;
        if (dot(pull, pull) > 1e-3) direction = mix(even, normalize(max(pull, 1e-6)), adapt * receiver.aggressivity);
        vec2 offset = rotation * direction * sqrt((float(i) + 0.5) / float(tap_count)) * shrink;
        vec2 uv = screen_from_view(receiver.position + axes * offset).xy;
        ivec2 neighbor = pixel_from_screen((1.0 - abs(1.0 - abs(uv))) * camera.extent.xy);  // mirrored at the border
        float weight = 0.0;
        if (is_on_screen(neighbor) && reflects(neighbor, max_roughness)) weight = neighbor_weight(receiver, own, neighbor);
        shrink = mix(shrink, weight, adapt);
        pull = mix(pull, even * (weight - 0.5), 0.5);
        if (weight == 0.0) continue;
        float other_age = texelFetch(reprojected_age, neighbor, 0).r;
        if (smooth_disocclusions && other_age < frames) {
            sums.age += 0.33 * weight * other_age;
            sums.age_weight += 0.33 * weight;
        }
        weight *= firefly_factor(traced_color(neighbor), frames);
        sums.history += weight * texelFetch(reprojected, neighbor, 0);
        sums.traced += weight * traced_color(neighbor);
        sums.weight += weight;
    }
    return sums;
}

vec4 blended(vec4 history, vec4 traced, float frames, Cross around) {
    float share = 1.0 / frames;
    share *= 1.0 - clamp(around.variation * adaptive_trust * (1.0 - share), 0.0, 0.9);
    float damping = 10.0 * flicker_suppression * mix(1.0 - adaptive_trust, 1.0, smoothstep(0.1, 2.0, around.variation));
    float of_history = (1.0 - share) / (1.0 + damping * luminance_of(history));
    float of_traced = share / (1.0 + damping * luminance_of(traced));
    return (of_history * history + of_traced * traced) / (of_history + of_traced);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 result = vec4(0.0);
    float frames = texelFetch(reprojected_age, pixel, 0).r;  // 0: nothing is reflected
    if (frames > 0.0) {
        Cross around = cross_of(pixel, abs(view_position(pixel).z));
        Sums sums = blurred_at(pixel, frames, around);
        frames = sums.age / sums.age_weight;
        result = blended(sums.history / sums.weight, sums.traced / sums.weight, frames, around);
    }
    imageStore(blurred, pixel, result);
    imageStore(age, pixel, vec4(frames));
    imageStore(reflections, pixel, result.a > 0.0 ? vec4(result.rgb / result.a, min(result.a, 1.0)) : vec4(0.0));
}
