// One ray per pixel of the targets, and what it meets.
#include "common/inward_rays.glsl"
#include "core/shaders/gbuffer/environment.glsl"
#include "diligent_ssr/half.glsl"
#include "diligent_ssr/hit.glsl"
#include "diligent_ssr/ray.glsl"

uniform sampler2D roughness, blue_noise, hit_color;
layout(location = 0) out vec4 ray_radiance;
layout(location = 1) out vec4 ray_direction;

const float mirror_roughness = 0.01;
const uint misses_see_environment = 1u;

// Pixel of a block of 2x2 that its ray stands for, in a pattern of 4x4 blocks that changes with no frame (DiligentFX).
// Bit 0: right, bit 1: lower; column by column of blocks.
const int pixel_of_block[16] = int[16](0, 1, 2, 3, 3, 2, 1, 0, 1, 0, 3, 2, 2, 3, 0, 1);

ivec2 pixel_of_ray(ivec2 ray) {
    if (!half_resolution) return ray;
    int place = pixel_of_block[4 * (ray.x & 3) + (ray.y & 3)];
    return min(2 * ray + ivec2(place & 1, place >> 1), ivec2(camera.extent.xy) - 1);
}

// The original's limit is 6; what it then reads of levels that images below 64 pixels lack is undefined.
int coarsest_level() {
    int extent = int(max(camera.extent.x, camera.extent.y)), level = 0;
    while (level < 6 && extent >> (level + 1) > 0) ++level;
    return level;
}

vec3 color_at(vec2 uv) {
    ivec2 pixel = ivec2(camera.extent.xy * uv);
    return is_on_screen(pixel) ? texelFetch(hit_color, pixel, 0).rgb : vec3(0.0);
}

void main() {
    ray_radiance = ray_direction = vec4(0.0);
    ivec2 ray = ivec2(gl_FragCoord.xy), pixel = pixel_of_ray(ray);
    float perceptual_roughness = texelFetch(roughness, pixel, 0).r;
    int coarsest = coarsest_level();
    int finest = perceptual_roughness < mirror_roughness ? 0 : min(int(most_detailed_mip), coarsest);

    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    vec3 origin = vec3(uv, surface_depth(ivec2(uv * camera.extent.xy / float(1 << finest)), finest));
    if (is_far_plane(texelFetch(depth_hierarchy, pixel, 0).r)) return;  // of a block that shows more than background
    vec3 vs_origin = view_from_march(origin);
    SampledRay sampled = sample_ray(view_direction(vs_origin), view_normal(pixel),
                                    perceptual_roughness * perceptual_roughness,
                                    texelFetch(blue_noise, ray & 127, 0).xy);
    MarchEnd end = march_hierarchy(screen_ray(origin, vs_origin, sampled.direction), finest, coarsest);

    vec3 ws_direction = mat3(camera.world_from_view) * sampled.direction;
    bool is_inward = inward_rays > 0u && dot(ws_direction, texelFetch(geometric_normal, pixel, 0).xyz) <= 0.0;
    bool is_miss = is_inward || (reject_unfinished && end.is_unfinished);
    float confidence = is_miss ? 0.0 : hit_confidence(origin, end.position, ws_direction);
    vec3 hit = vec3(0.0);
    if (confidence > 0.0) hit = color_at(previous_frame ? previous_uv(end.position.xy) : end.position.xy);
    if (is_inward && inward_rays == inward_rays_black)
        ray_radiance = vec4(0.0, 0.0, 0.0, 1.0);
    else if (misses == misses_see_environment)
        ray_radiance = vec4(mix(environment_along_ray(pixel, ws_direction), hit, confidence), 1.0);
    else
        ray_radiance = vec4(hit * (premultiply_confidence ? confidence : 1.0), confidence);
    float distance = length(view_from_march(end.position) - vs_origin);
    ray_direction = vec4(ws_direction * distance, sampled.density);
    if (float_rays) return;
    ray_radiance = as_halves(ray_radiance);
    ray_direction = as_halves(ray_direction);
}
