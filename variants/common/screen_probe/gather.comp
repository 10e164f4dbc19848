// Asks the screen what lies in the directions of each texel, and remembers what has left it.
#include "common/mirror_ray.glsl"
#include "common/screen_probe/octahedral_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D lit, previous_probe_seen, previous_probe_facts;
// Seen: a share of the texel's directions in which there are surfaces, rgb that times their radiance. Facts: x that times
// the mean of 1 / distance (1/m), y share of the directions that were on the screen.
uniform writeonly image2D probe_seen, probe_facts;

struct Samples {
    float on_screen;        // number
    vec4 surfaces;          // of those with a surface: sum of radiance, number
    float inverse_lengths;  // of the same: sum
};

void add_pixel(inout Samples samples, ivec2 pixel) {
    samples.on_screen += 1.0;
    float device_depth = texelFetch(depth, pixel, 0).r;
    if (is_background(device_depth)) return;
    vec3 radiance = texelFetch(lit, pixel, 0).rgb - texelFetch(emission, pixel, 0).rgb;
    if (any(isnan(radiance)) || any(isinf(radiance))) return;
    const float largest_radiance = 65504.0;  // of halves; sums of it are finite
    samples.surfaces += vec4(clamp(radiance, 0.0, largest_radiance), 1.0);
    const float least_distance = 1e-6;  // m
    samples.inverse_lengths += 1.0 / max(length(view_position_at(pixel, device_depth)), least_distance);
}

Samples samples_of(ivec2 texel) {
    const int rows = 8;
    Samples samples = Samples(0.0, vec4(0.0), 0.0);
    for (int i = 0; i < rows * rows; ++i) {
        vec2 place = vec2(texel) + (vec2(i % rows, i / rows) + 0.5) / float(rows);
        vec3 direction = mat3(camera.view_from_world) * direction_of_place(2.0 * place / float(probe_width) - 1.0);
        vec4 clip = camera.clip_from_view * vec4(direction, 0.0);
        if (clip.w <= 0.0) continue;
        ivec2 pixel = pixel_from_screen((clip.xy / clip.w * 0.5 + 0.5) * camera.extent.xy);
        if (is_on_screen(pixel)) add_pixel(samples, pixel);
    }
    samples.on_screen /= float(rows * rows);
    samples.surfaces /= float(rows * rows);
    samples.inverse_lengths /= float(rows * rows);
    return samples;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(probe_width)))) return;
    Samples samples = samples_of(texel);
    float has_previous = float(camera.frame.w);
    vec4 seen = has_previous * texelFetch(previous_probe_seen, texel, 0);
    vec2 facts = has_previous * texelFetch(previous_probe_facts, texel, 0).xy;
    if (samples.on_screen > 0.0) {
        // A texel of which more was on the screen keeps its part for the rest.
        float known = max(samples.on_screen, facts.y);
        float kept = facts.y > 0.0 ? (known - samples.on_screen) / facts.y : 0.0;
        seen = kept * seen + samples.surfaces;
        facts = vec2(kept * facts.x + samples.inverse_lengths, known);
    }
    imageStore(probe_seen, texel, seen);
    imageStore(probe_facts, texel, vec4(facts, 0.0, 0.0));
}
