// Gathers what the screen shows in the directions of each texel, and keeps what has left the screen. A workgroup looks
// in all directions of a texel at once: one invocation for each texel would keep a GPU waiting for a few waves.
#include "common/mirror_ray.glsl"
#include "common/half.glsl"
#include "common/luminance.glsl"
#include "common/screen_probe/octahedral_map.glsl"
#include "core/shaders/gbuffer/environment.glsl"

const uint group_terms = 5u;
#include "common/screen_probe/group_sum.glsl"
layout(local_size_x = 8, local_size_y = 8) in;  // directions of a texel
uniform sampler2D lit, previous_probe_seen, previous_probe_facts;
// Seen: a share of the texel's directions in which there are surfaces, rgb that times their radiance. Facts: x that times
// the mean of 1 / distance (1/m), y share of the directions that were on the screen.
uniform writeonly image2D probe_seen, probe_facts;
// Of the surfaces on the screen, by texel: sums of luminance and of luminance times normal (world space), as they are lit,
// and as the whole environment alone would light them.
uniform writeonly image2D probe_lit, probe_unoccluded;
// Of the environment in the texel's directions: luminance times solid angle over that of all directions, alone (w) and
// times the direction.
uniform writeonly image2D probe_environment;
uniform sampler2D previous_probe_moments;  // of spread.comp

struct Samples {
    float on_screen;        // number
    vec4 surfaces;          // of those with a surface: sum of radiance, number
    float inverse_lengths;  // of the same: sum
    vec4 lit, unoccluded;   // of probe_lit, probe_unoccluded
    vec4 environment;       // of probe_environment
};

// Luminance over pi with which it would light a surface, unoccluded and up to first moments (Ramamoorthi and
// Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps").
float unoccluded_light(vec4 moments, vec3 ws_normal) { return max(moments.w + 2.0 * dot(moments.xyz, ws_normal), 0.0); }

void add_light(inout Samples samples, ivec2 pixel, vec3 radiance, vec4 moments) {
    vec3 ws_normal = texelFetch(normal, pixel, 0).xyz;
    vec4 color_metalness = texelFetch(base_color, pixel, 0);
    vec3 by_environment = (1.0 - color_metalness.w) * color_metalness.rgb * unoccluded_light(moments, ws_normal);
    float expected = luminance_bt709(by_environment), length_of_normal = length(ws_normal);
    bool is_sound = expected >= 0.0 && expected <= largest_half && abs(length_of_normal - 1.0) < 0.1;
    if (!is_sound) return;
    samples.lit += luminance_bt709(radiance) * vec4(ws_normal, 1.0);
    samples.unoccluded += expected * vec4(ws_normal, 1.0);
}

void add_pixel(inout Samples samples, ivec2 pixel, vec4 moments) {
    samples.on_screen += 1.0;
    float device_depth = texelFetch(depth, pixel, 0).r;
    if (is_background(device_depth)) return;
    vec3 radiance = texelFetch(lit, pixel, 0).rgb - texelFetch(emission, pixel, 0).rgb;
    if (any(isnan(radiance)) || any(isinf(radiance))) return;
    samples.surfaces += vec4(clamp(radiance, 0.0, largest_half), 1.0);
    add_light(samples, pixel, clamp(radiance, 0.0, largest_half), moments);
    const float least_distance = 1e-6;  // m
    samples.inverse_lengths += 1.0 / max(length(view_position_at(pixel, device_depth)), least_distance);
}

// Share of all directions that a square has of which there are so many in a row of the map.
float solid_angle(vec3 direction, int squares) {
    vec3 a = abs(direction);
    float side = 2.0 / float(squares), stretch = a.x + a.y + a.z;
    return side * side * stretch * stretch * stretch / (4.0 * pi);
}

Samples sample_at(ivec2 texel, ivec2 inside, int rows) {
    Samples samples = Samples(0.0, vec4(0.0), 0.0, vec4(0.0), vec4(0.0), vec4(0.0));
    vec2 place = vec2(texel) + (vec2(inside) + 0.5) / float(rows);
    vec3 ws_direction = octahedral_direction(2.0 * place / float(probe_width) - 1.0);
    // Captures know the environment in the directions of their pixels' lobes alone.
    float luminance = is_environment(3u) ? 0.0 : luminance_bt709(environment_along_ray(ivec2(0), ws_direction));
    samples.environment = solid_angle(ws_direction, rows * probe_width) * luminance * vec4(ws_direction, 1.0);
    vec3 direction = mat3(camera.view_from_world) * ws_direction;
    vec4 clip = camera.clip_from_view * vec4(direction, 0.0);
    if (clip.w <= 0.0) return samples;
    ivec2 pixel = pixel_from_screen((clip.xy / clip.w * 0.5 + 0.5) * camera.extent.xy);
    vec4 moments = float(camera.frame.w) * texelFetch(previous_probe_moments, ivec2(0), 0);
    if (is_on_screen(pixel)) add_pixel(samples, pixel, moments);
    return samples;
}

Samples sum_over_group(Samples own) {
    vec4 terms[group_terms] = vec4[group_terms](own.surfaces, own.lit, own.unoccluded, own.environment,
                                                vec4(own.on_screen, own.inverse_lengths, 0.0, 0.0));
    terms = group_sum(terms);
    return Samples(terms[4].x, terms[0], terms[4].y, terms[1], terms[2], terms[3]);
}

void main() {
    ivec2 texel = ivec2(gl_WorkGroupID.xy);
    int rows = int(gl_WorkGroupSize.y);
    Samples samples = sum_over_group(sample_at(texel, ivec2(gl_LocalInvocationID.xy), rows));
    if (gl_LocalInvocationIndex != 0u) return;
    samples.on_screen /= float(rows * rows);
    samples.surfaces /= float(rows * rows);
    samples.inverse_lengths /= float(rows * rows);
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
    imageStore(probe_environment, texel, samples.environment);
    imageStore(probe_lit, texel, samples.lit);
    imageStore(probe_unoccluded, texel, samples.unoccluded);
    imageStore(probe_seen, texel, seen);
    imageStore(probe_facts, texel, vec4(facts, 0.0, 0.0));
}
