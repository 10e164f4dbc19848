// A pixel's rays, their colours, and the composite's fades that do not depend on rays. The including file decides how
// rays march.
#include "common/ggx_lobe.h"
#include "common/half.glsl"
#include "common/halton.h"
#include "common/luminance.glsl"
#include "common/motion.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D lit, blue_noise;
uniform writeonly image2D traced, reflection_way;

const uint mode_hiz = 1u;             // parameter `mode`; those above draw at random
const uint mode_temporal = 3u;
const uint place_of_reflection = 2u;  // parameter `history_place`
const uint weights_ratio = 1u;        // parameter `weights`
const uint noise_white = 1u;          // parameter `noise`
const float least_confidence = 1e-4;  // well above the resolution of half floats

bool follows_reflections() { return mode == mode_temporal && history_place == place_of_reflection; }

struct DrawnRay {
    vec3 direction;  // in the frame of the shading normal
    float weight;    // 0: below the horizon, not to be traced
};

// Four numbers in [0, 1) for ray k of a pixel. Blue: the texel's, from where rays and frames go on by irrational steps:
// for the direction those of Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences", then the golden
// ratio and the root of 2. Another seed moves texels and numbers (Cranley and Patterson 1976). In units of 2^-32.
vec4 random_numbers(ivec2 pixel, uint k) {
    if (noise == noise_white) {
        uvec4 key = uvec4(pixel, camera.frame.x, camera.frame.y << 5 | k << 2);
        return vec4(random_point(key), random_point(key + uvec4(0u, 0u, 0u, 1u)).x,
                    random_point(key + uvec4(0u, 0u, 0u, 2u)).x);
    }
    uvec2 texel = uvec2(pixel);
    uvec4 rotation = uvec4(0u);
    if (camera.frame.y != 0u) {
        rotation = pcg4d(uvec4(camera.frame.y, 0u, 0u, 0u));
        texel += pcg4d(uvec4(camera.frame.y, 1u, 0u, 0u)).xy;
    }
    uvec4 code = uvec4(texelFetch(blue_noise, ivec2(texel % uvec2(textureSize(blue_noise, 0))), 0) * 255.0 + 0.5);
    const uvec4 step = uvec4(3242174889u, 2447445413u, 2654435769u, 1779033703u);
    uvec4 number = (code << 24) + (1u << 23) + (camera.frame.x * num_rays + k) * step + rotation;
    return vec4(number >> 8) * (1.0 / 16777216.0);
}

// One ray of the mixture ("GGX Importance Sampling"; brdfBias). u: in [0, 1).
DrawnRay draw_ray(vec3 o, float alpha, vec3 u) {
    bool is_of_lobe = u.z < brdf_bias;
    vec3 direction;
    if (is_of_lobe) {
        direction = sample_lobe(lobe_of_normals, o, alpha, 0.0, u.xy).direction;
    } else {
        direction = vec3(sqrt(max(0.0, 1.0 - u.x * u.x)) * unit_circle(u.y), u.x);
    }
    if (!(direction.z > 0.0)) return DrawnRay(direction, 0.0);
    if (weights != weights_ratio) return DrawnRay(direction, 1.0);
    float uniform_density = 0.5 / pi;
    float density = mix(uniform_density, lobe_density(lobe_of_normals, o, direction, alpha), brdf_bias);
    return DrawnRay(direction, lobe_density(lobe_of_visible_normals, o, direction, alpha) / density);
}

// uv now - uv before of the surface, by the previous camera.
vec2 way_of_surface(vec3 origin) {
    vec4 clip = camera.previous_clip_from_world * (camera.world_from_view * vec4(origin, 1.0));
    return screen_from_view(origin).xy - (clip.xy / clip.w * 0.5 + 0.5);
}

// uv now - uv before (un-jittered) of the mirror image of what a ray hit: it lies behind the surface as far as the hit
// lies before it, and moves as the hit does, mirrored. What moves is taken to keep its distance from the camera, which
// motion vectors do not contain.
vec2 way_of_image(vec3 origin, vec3 vs_normal, TraceEnd end) {
    mat3 world_from_view = mat3(camera.world_from_view);
    vec2 uv = screen_from_pixel(end.pixel) * camera.extent.zw;
    vec3 hit = world_from_screen(uv, texelFetch(depth, end.pixel, 0).r);
    vec4 clip = camera.previous_clip_from_world * vec4(hit, 1.0);
    vec4 view = camera.previous_view_from_clip *
                vec4((uv - motion_at(end.pixel)) * 2.0 - 1.0, clip.z / clip.w, 1.0);
    vec3 hit_before = (camera.previous_world_from_view * vec4(view.xyz / view.w, 1.0)).xyz;
    vec3 vs_image = origin + view_direction(origin) * end.distance;
    vec3 image_before = (camera.world_from_view * vec4(vs_image, 1.0)).xyz -
                        reflect(hit - hit_before, world_from_view * vs_normal);
    vec4 image_clip = camera.previous_clip_from_world * vec4(image_before, 1.0);
    if (!(image_clip.w > 0.0)) return way_of_surface(origin);  // behind that camera
    return screen_from_view(vs_image).xy - (image_clip.xy / image_clip.w * 0.5 + 0.5);
}

// way: of the history that belongs to it, if it follows reflections.
vec4 trace_pixel(ivec2 pixel, out vec2 way) {
    vec3 origin = view_position(pixel), towards_surface = view_direction(origin);
    vec3 n = view_normal(pixel), vs_geometric_normal = view_geometric_normal(pixel);
    float alpha = ggx_alpha(texelFetch(normal, pixel, 0).w);
    bool is_stochastic = mode > mode_hiz;
    mat3 view_from_local = basis_from_normal(n);
    vec3 o = -towards_surface * view_from_local;
    vec4 sum = vec4(0.0);  // of weight * confidence: colour, 1
    vec3 way_sum = vec3(0.0);  // of that times luminance: the way, 1
    way = vec2(0.0);
    float weight_sum = 0.0;
    for (uint k = 0u; k < (is_stochastic ? num_rays : 1u); ++k) {
        vec4 random = random_numbers(pixel, k);
        DrawnRay drawn = DrawnRay(vec3(-o.xy, o.z), 1.0);
        if (is_stochastic) drawn = draw_ray(o, alpha, random.xyz);
        if (!(drawn.weight > 0.0)) continue;
        TraceEnd end = march(TraceRay(pixel, k, origin, view_from_local * drawn.direction, vs_geometric_normal,
                                      random.w, !is_stochastic));
        weight_sum += drawn.weight;
        if (end.outcome != outcome_hit) continue;
        vec3 color = texelFetch(lit, end.pixel, 0).rgb;
        sum += drawn.weight * end.confidence * vec4(color, 1.0);
        if (follows_reflections())
            way_sum += drawn.weight * end.confidence * luminance_bt709(color) * vec3(way_of_image(origin, n, end), 1.0);
    }
    if (follows_reflections()) {
        vec2 of_surface = way_of_surface(origin), by_vector = motion_at(pixel);
        bool stands_still = length((by_vector - of_surface) * camera.extent.xy) < 0.5;
        way = !stands_still ? by_vector : way_sum.z > 0.0 ? way_sum.xy / way_sum.z : of_surface;
    }
    return sum.a > 0.0 ? vec4(sum.rgb / sum.a, sum.a / weight_sum) : vec4(0.0);
}

// The composite's weight but for Fresnel ("Composite Pass").
float fade_of_surface(ivec2 pixel) {
    return (1.0 - clamp(texelFetch(normal, pixel, 0).w / roughness_fade, 0.0, 1.0)) * intensity;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 result = vec4(0.0);
    vec2 way = vec2(0.0);
    float fade = 0.0;
    bool is_sky_pixel = is_sky(texelFetch(depth, pixel, 0).r, sky_depth);
    if (!is_sky_pixel && reflects(pixel, roughness_fade) &&
        dot(view_direction(view_position(pixel)), view_normal(pixel)) < 0.0)
        fade = fade_of_surface(pixel);
    if (fade > 0.0) result = trace_pixel(pixel, way) * vec4(1.0, 1.0, 1.0, fade);
    if (follows_reflections()) imageStore(reflection_way, pixel, vec4(way, 0.0, 0.0));
    imageStore(traced, pixel, result.a < least_confidence ? vec4(0.0) : min(result, vec4(largest_half)));
}
