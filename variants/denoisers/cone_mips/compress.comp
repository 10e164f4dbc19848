// Writes, for each traced pixel, what its rays see as the finest mip, and the level that its cone chooses.
#include "common/mirror_ray.glsl"
#include "core/shared/brdf.h"
#include "frostbite_sssr/lobe_cone.h"
#include "denoisers/cone_mips/stored_color.glsl"
#include "denoisers/pixel_scale.glsl"
#include "denoisers/traced_pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { float last_level; };
uniform sampler2D own_radiance, own_length;
uniform writeonly image2D finest, cone_level;

// Variance (texels of level 0, of each axis) of level m over 4^m - 1: each level adds that of the mean of two texels of
// the one before, and that of the weights of blur.comp.
const float variance_of_levels = 3.7038;

// m, up to where the ray leaves the view.
float length_in_view(Ray ray) {
    vec4 from = camera.clip_from_view * vec4(ray.origin, 1.0),
         per_metre = camera.clip_from_view * vec4(ray.direction, 0.0);
    // Of each of its planes, left, top, right, bottom, near and far: distance of the origin, and its growth per m.
    float inside[6] = float[6](from.w + from.x, from.w + from.y, from.w - from.x, from.w - from.y,
                               -ray.origin.z - camera.depth.x, ray.origin.z + camera.depth.y);
    float growth[6] = float[6](per_metre.w + per_metre.x, per_metre.w + per_metre.y, per_metre.w - per_metre.x,
                               per_metre.w - per_metre.y, -ray.direction.z, ray.direction.z);
    float result = 3.402823466e38;
    for (int i = 0; i < 6; ++i)
        if (growth[i] < 0.0) result = min(result, max(inside[i], 0.0) / -growth[i]);
    return result;
}

float length_on_screen(Ray ray, float ray_length) {
    vec2 moved = screen_from_view(ray.origin + ray_length * ray.direction).xy - screen_from_view(ray.origin).xy;
    vec2 extent = camera.extent.xy;
    return length(square_lengths ? moved * extent / max(extent.x, extent.y) : moved);
}

// Of the sphere that fits into a cone of this length and touches its base, over the length.
float sphere_of_cone(float roughness) {
    float half_angle = 0.5 * pi * min(roughness, 0.999);
    return sin(half_angle) / (1.0 + sin(half_angle));
}

float level_of_cone(float roughness, float screen_length) {
    ivec2 extent = traced_extent();
    float radius = sphere_of_cone(roughness) * screen_length * float(max(extent.x, extent.y));
    float level = clamp(log2(1.0 + radius / level_radius), 0.0, last_level);
    float left = clamp(far_end - screen_length, 0.0, 1.0);
    return far_power > 0.0 ? level * pow(left, far_power) : level;
}

// A level between two is their mix, whose variance is the mix of theirs.
float level_of_variance(float variance) {
    float power = 1.0 + variance / variance_of_levels;
    float below = floor(0.5 * log2(power));
    return clamp(below + (power * exp2(-2.0 * below) - 1.0) / 3.0, 0.0, last_level);
}

float level_of_lobe(float roughness, Ray ray, float ray_length) {
    const float half_of_gaussian = 1.17741;  // radius that holds half of it, over its standard deviation: sqrt(2 ln 2)
    vec3 towards_surface = view_direction(ray.origin);
    float mu_o = sqrt(max(0.5 - 0.5 * dot(towards_surface, ray.direction), 0.0));  // of half the angle between them
    float tangent = lobe_cone_tangent(roughness * roughness, 0.0) * lobe_cone_narrowing(mu_o);
    float radius = tangent * ray_length * pixels_per_metre(ray.origin + ray_length * towards_surface);
    float deviation = radius * float(traced_extent().y) * camera.extent.w / half_of_gaussian;
    deviation = min(deviation, 1e6);  // wider than any image, and its square is finite
    return level_of_variance(deviation * deviation);
}

float level_of(ivec2 pixel) {
    float roughness = texelFetch(normal, pixel, 0).w;
    if (roughness <= mirror_roughness) return 0.0;
    Ray ray = mirror_ray(pixel);
    // Without a hit up to the border, so that levels do not jump at silhouettes.
    float hit_length = texelFetch(own_length, pixel, 0).r, in_view = length_in_view(ray);
    float ray_length = hit_length > 0.0 ? hit_length : in_view;
    return lobe_cone ? level_of_lobe(roughness, ray, ray_length)
                     : level_of_cone(roughness, length_on_screen(ray, min(ray_length, in_view)));
}

void main() {
    ivec2 traced = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(traced, traced_extent()))) return;
    ivec2 pixel = traced_pixel(traced, camera.frame.x);
    vec4 own = texelFetch(own_radiance, pixel, 0);
    imageStore(finest, traced, stored_color(own));
    imageStore(cone_level, traced, vec4(reflects(pixel, max_roughness) ? level_of(pixel) : 0.0));
}
