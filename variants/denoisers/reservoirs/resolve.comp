// Combines neighbours' reservoirs, weighed by the pixel's own lobe.
#include "denoisers/lobe_disk.glsl"
#include "denoisers/pixel_scale.glsl"
#include "denoisers/reservoirs/reservoir.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D reservoir_radiance, reservoir_hit, reservoir_origin;
uniform writeonly image2D reflections;

const int tap_count = 8;  // besides the pixel's own

Reservoir reservoir_at(ivec2 pixel) {
    return unpacked_reservoir(texelFetch(reservoir_radiance, pixel, 0), texelFetch(reservoir_hit, pixel, 0),
                              texelFetch(reservoir_origin, pixel, 0));
}

vec3 view_from_world_position(vec3 world) { return (camera.view_from_world * vec4(world, 1.0)).xyz; }

// View space.
struct Receiver {
    vec3 position, normal;
    Lobe lobe;
    float radius;  // of the disk of neighbours (m)
};

// m. Of the part of the mirror image that a lobe covers, on the surface.
float disk_radius(vec3 position, float alpha, float ray_length) {
    float half_height = 0.5 * camera.extent.y / pixels_per_metre(position);
    float camera_distance = camera.frame.z == 1u ? abs(position.z) : length(position);
    float size = max(ray_length, 0.2 * half_height * smoothstep(0.0, 0.05 * camera_distance, ray_length));
    float covered = size / (size + camera_distance) * abs(position.z) * sqrt(alpha) * disk_scale;
    return clamp(covered, 2.0 * min_radius * camera.extent.w * half_height,
                 max(2.0 * max_radius, 2.0 * min_radius * camera.extent.w) * half_height);
}

Receiver receiver_at(ivec2 pixel) {
    Receiver receiver;
    receiver.position = view_position(pixel);
    receiver.normal = view_normal(pixel);
    receiver.lobe = lobe_at(pixel);
    Reservoir own = reservoir_at(pixel);
    float ray_length = own.weight > 0.0 ? length(view_from_world_position(own.hit) - receiver.position) : 0.0;
    receiver.radius = disk_radius(receiver.position, receiver.lobe.alpha, ray_length);
    return receiver;
}

// The direction that dominates what the lobe brings (Lagarde and de Rousiers 2014, "Moving Frostbite to PBR").
mat2x3 disk_axes(Receiver receiver) {
    float smoothness = 1.0 - receiver.lobe.alpha;
    vec3 mirrored = reflect(view_direction(receiver.position), receiver.normal);
    vec3 dominant = mix(receiver.normal, mirrored, smoothness * (sqrt(smoothness) + receiver.lobe.alpha));
    return receiver.radius * disk_towards(normalize(dominant), receiver.normal);
}

struct Sums {
    vec3 radiance;
    float weight;
};

// Whether the neighbour's hit would be hidden by the slope on which the pixel and its neighbour lie.
bool is_shadowed(Receiver receiver, vec3 direction, vec3 offset) {
    return 0.2 * dot(direction, receiver.normal) < dot(offset, receiver.normal) / max(length(offset), 1e-12);
}

float likeness(Receiver receiver, ivec2 neighbor, vec3 position) {
    if (ggx_alpha(texelFetch(normal, neighbor, 0).w) > 2.0 * receiver.lobe.alpha) return 0.0;
    if (dot(receiver.normal, view_normal(neighbor)) <= 0.7) return 0.0;
    float deeper = (receiver.position.z - position.z) / receiver.radius;
    return exp2(-max(0.3, abs(receiver.normal.z)) * deeper * deeper);
}

void add(inout Sums sums, Receiver receiver, ivec2 pixel, ivec2 neighbor) {
    Reservoir kept = reservoir_at(neighbor);
    if (kept.weight <= 0.0) return;
    vec3 position = view_position(neighbor), hit = view_from_world_position(kept.hit);
    // From halfway between both, which trades a wrong place of the hit for a direction that both lobes hold.
    vec3 to_hit = hit - mix(receiver.position, position, 0.5), from_neighbor = hit - position;
    float squared_length = max(dot(to_hit, to_hit), 1e-12);
    vec3 direction = to_hit * inversesqrt(squared_length);
    bool is_own = neighbor == pixel;
    float alike = is_own ? 1.0 : likeness(receiver, neighbor, position);
    if (alike == 0.0 || dot(direction, receiver.normal) < 1e-5) return;
    if (!is_own && is_shadowed(receiver, direction, position - receiver.position)) return;
    float density = density_of(receiver.lobe, direction);
    float counted = min(density, max_density);
    // How much denser the neighbour's rays are as seen from here. Never thinner: that would raise what a tap brings.
    float spread = squared_length / max(dot(from_neighbor, from_neighbor), 1e-12);
    // The balance heuristic of Veach and Guibas 1995 between the pixel's lobe and the neighbour's.
    float balance = max(density / (kept.density + density), 1e-4);
    float weight = alike * balance * max(density / max(counted, 1e-30), 1e-10);
    sums.radiance += weight * kept.radiance * (counted * kept.weight / max(spread, 1.0));
    sums.weight += weight;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    Sums sums = Sums(vec3(0.0), 0.0);
    if (reflects(pixel, max_roughness)) {
        Receiver receiver = receiver_at(pixel);
        add(sums, receiver, pixel, pixel);
        mat2x3 axes = disk_axes(receiver);
        float angle = rotation_of(pixel), shift = random_pair(pixel, 0u, tap_dimension).y;
        for (int i = 0; i < tap_count && spatial_reuse; ++i) {
            float turn = angle + float(i) * golden_angle;
            vec2 offset = vec2(cos(turn), sin(turn)) * pow((float(i) + shift) / float(tap_count), 2.0 / 3.0);
            vec2 uv = screen_from_view(receiver.position + axes * offset).xy;
            ivec2 neighbor = pixel_from_screen(uv * camera.extent.xy);
            if (neighbor != pixel && is_on_screen(neighbor) && reflects(neighbor, max_roughness))
                add(sums, receiver, pixel, neighbor);
        }
    }
    imageStore(reflections, pixel, sums.weight > 0.0 ? vec4(sums.radiance / sums.weight, 1.0) : vec4(0.0));
}
