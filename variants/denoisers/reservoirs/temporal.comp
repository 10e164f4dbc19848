// Keeps either this frame's ray or the ray in the previous frame's reservoir, at random in proportion to what each sees
// times its density. On average over frames no ray is lost (Talbot et al. 2005, "Importance Resampling").
#include "frostbite_sssr/previous_view.glsl"
#include "denoisers/place_before.glsl"
#include "denoisers/reservoirs/reservoir.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D ray_radiance, ray_direction, fallback, previous_reservoir_radiance, previous_reservoir_hit,
    previous_reservoir_origin;
uniform writeonly image2D reservoir_radiance, reservoir_hit, reservoir_origin;

float target_of(Reservoir kept) { return max(luminance_bt709(kept.radiance), min_luminance) * kept.density; }

// Densities are those of the whole lobe, though rays below the horizon or in the tail are not drawn: what is shown is
// the mean of what the others see. With half_resolution the ray is that of a pixel beside, with its place and density.
Reservoir traced_reservoir(ivec2 pixel) {
    vec4 seen = texelFetch(ray_radiance, pixel, 0), ray = texelFetch(ray_direction, pixel, 0);
    if (ray.w <= 0.0) return empty_reservoir;
    vec3 origin = world_position(traced_pixel(half_resolution ? pixel >> 1 : pixel, camera.frame.x)).xyz;
    float density = ray.w;
    if (!half_resolution) density = density_of(lobe_at(pixel), normalize(mat3(camera.view_from_world) * ray.xyz));
    if (density < 1e-12) return empty_reservoir;
    density = min(density, max_density);
    vec3 radiance = seen.rgb + (1.0 - seen.a) * texelFetch(fallback, pixel, 0).rgb;
    return Reservoir(radiance, density, origin + ray.xyz, 1.0 / density, origin, 1.0);
}

Reservoir reservoir_before(ivec2 pixel) {
    vec2 place = surface_before(pixel);
    bool is_first_frame = camera.frame.w == 0u;
    bool is_inside = all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, camera.extent.xy));
    if (is_first_frame || !is_inside) return empty_reservoir;
    ivec2 texel = ivec2(place);
    return unpacked_reservoir(texelFetch(previous_reservoir_radiance, texel, 0),
                              texelFetch(previous_reservoir_hit, texel, 0),
                              texelFetch(previous_reservoir_origin, texel, 0));
}

// How alike the lobe is that the previous camera saw, in [0, 1]: that of a narrow one turns away with the view.
float likeness_of_views(vec3 world, vec3 towards_surface, float alpha) {
    vec3 before = (camera.previous_view_from_world * vec4(world, 1.0)).xyz;
    vec3 turned = cross(towards_surface, mat3(camera.previous_world_from_view) * view_direction(before));
    // The GGX distribution at this angle over that at 0, by its sine: the cosine of a small angle rounds to 1.
    float a2 = max(alpha * alpha, 3e-5), fall = a2 / (a2 + dot(turned, turned) * (1.0 - a2));
    return mix(pow(fall, 128.0), 1.0, smoothstep(0.05, 0.5, sqrt(alpha)));
}

// Over the target of the ray at its own origin, for the pixel that takes it over; 0 where it may not.
float reprojected_share(Reservoir before, vec3 origin, vec3 ws_normal, float camera_distance, float alpha) {
    vec3 moved = origin - before.origin, to_hit = before.hit - origin, from_before = before.hit - before.origin;
    if (dot(moved, moved) > max_offset * camera_distance * camera_distance) return 0.0;
    if (dot(to_hit, ws_normal) <= 0.0) return 0.0;
    float lengths = dot(from_before, from_before) / max(dot(to_hit, to_hit), 1e-12);
    float limit = mix(1.1, 4.0, alpha * alpha);
    return lengths < limit && lengths * limit > 1.0 ? lengths : 0.0;
}

Reservoir merged(ivec2 pixel, Reservoir traced, Reservoir before, float share) {
    float traced_sum = target_of(traced) * traced.weight * traced.count;
    float before_target = share * target_of(before), before_sum = before_target * before.weight * before.count;
    float sum = traced_sum + before_sum, count = traced.count + before.count;
    if (before_sum <= 0.0) return traced;
    bool keeps_before = random_pair(pixel, 0u, tap_dimension).x * sum < before_sum;
    Reservoir kept = traced;
    if (keeps_before) kept = before;
    kept.weight = min(sum / (count * (keeps_before ? before_target : target_of(traced))), 1e20);
    kept.count = count;
    return kept;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    Reservoir kept = empty_reservoir;
    if (reflects(pixel, max_roughness)) {
        vec3 origin = world_position(pixel).xyz, vs_position = view_position(pixel);
        kept = traced_reservoir(pixel);
        Reservoir before = reservoir_before(pixel);
        if (temporal_reuse && before.weight > 0.0) {
            vec4 surface = texelFetch(normal, pixel, 0);
            float alpha = ggx_alpha(surface.w);
            vec3 towards_surface = mat3(camera.world_from_view) * view_direction(vs_position);
            before.count = min(before.count, max_history) * likeness_of_views(origin, towards_surface, alpha);
            kept = merged(pixel, kept, before,
                          reprojected_share(before, origin, surface.xyz, abs(vs_position.z), alpha));
        }
    }
    imageStore(reservoir_radiance, pixel, vec4(kept.radiance, kept.density));
    imageStore(reservoir_hit, pixel, vec4(kept.hit, kept.weight));
    imageStore(reservoir_origin, pixel, vec4(kept.origin, kept.count));
}
