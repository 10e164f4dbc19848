#include "tests/variants/denoiser_scene.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr float glossy_alpha = 0.2f;  // default of roughness_threshold_alpha

DenoiserInputs blank_inputs(glm::uvec2 extent, const CameraData& camera) {
    return {.camera = camera,
            .depth = {extent, 1, camera.depth.z},
            .normal = {extent, 4},
            .motion = {extent, 2},
            .radiance = {extent, 4},
            .roughness = {extent, 1, 1.0f},
            .tiles = {(extent + 7u) / 8u, 1}};
}

/// In [0, 1).
float random_number(unsigned x, unsigned y, unsigned frame) {
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ frame * 0xc2b2ae3du;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    return float((h ^ h >> 13) & 0xffff) / 65536.0f;
}

struct Hit {
    float distance;
    glm::vec3 normal;
    float alpha;
};

/// The wall at z = -6, the floor at y = -1, a ball of radius 0.7 that stands on it.
Hit nearest_hit(const CameraRay& ray) {
    Hit hit{(-6.0f - ray.origin.z) / ray.direction.z, {0, 0, 1}, 0.8f};
    const float to_floor = (-1.0f - ray.origin.y) / ray.direction.y;
    if (to_floor > 0 && to_floor < hit.distance) {
        constexpr float strips[6] = {0.0f, 0.003f, 0.03f, 0.1f, 0.19f, 0.5f};
        const float x = ray.origin.x + to_floor * ray.direction.x;
        hit = {to_floor, {0, 1, 0}, strips[int(std::clamp(x + 3.0f, 0.0f, 5.0f))]};
    }
    const glm::vec3 from_center = ray.origin - glm::vec3(0.3f, -0.3f, -4.0f);
    const float b = glm::dot(from_center, ray.direction), c = glm::dot(from_center, from_center) - 0.49f;
    const float to_ball = b * b < c ? INFINITY : -b - std::sqrt(b * b - c);
    if (to_ball < hit.distance) hit = {to_ball, glm::normalize(from_center + to_ball * ray.direction), 0.05f};
    return hit;
}

void fill_pixel(DenoiserInputs& inputs, const CameraRay& ray, unsigned x, unsigned y, unsigned index) {
    const Hit hit = nearest_hit(ray);
    const glm::vec4 point(ray.origin + hit.distance * ray.direction, 1.0f);
    const glm::vec4 clip = inputs.camera.clip_from_world * point;
    const glm::vec4 before = inputs.camera.previous_clip_from_world * point;
    const glm::vec2 motion = 0.5f * (glm::vec2(clip) / clip.w - glm::vec2(before) / before.w);
    const glm::vec3 mirrored = glm::reflect(ray.direction, hit.normal);
    const float length = mirrored.z < -0.01f ? (-6.0f - point.z) / mirrored.z : 10.0f;
    const glm::vec3 seen = glm::vec3(point) + length * mirrored + 4 * hit.alpha * (random_number(x, y, index) - 0.5f);
    const bool is_bright = (int(std::floor(seen.x)) + int(std::floor(seen.y))) & 1;
    const glm::vec3 color = is_bright ? glm::vec3(1.7f, 1.2f, 0.8f) : glm::vec3(0.05f, 0.1f, 0.2f);
    *inputs.depth.pixel(x, y) = clip.z / clip.w;
    *inputs.roughness.pixel(x, y) = std::round(hit.alpha * 255) / 255;
    for (int i = 0; i < 2; ++i) inputs.motion.pixel(x, y)[i] = motion[i];
    for (int i = 0; i < 3; ++i) {
        inputs.normal.pixel(x, y)[i] = hit.normal[i];
        inputs.radiance.pixel(x, y)[i] = hit.alpha < glossy_alpha ? color[i] : 0.3f;
    }
    inputs.radiance.pixel(x, y)[3] = hit.alpha < glossy_alpha ? length : 0.0f;
    if (hit.alpha < glossy_alpha) *inputs.tiles.pixel(x / 8, y / 8) = 1;
}

}  // namespace

glm::vec3 checkered(unsigned x, unsigned y) { return glm::vec3((x + y) % 2 ? 0.25f : 0.75f); }

DenoiserInputs facing_wall(const FacingWall& wall) {
    CameraPose pose, before;
    pose.world_from_view[3].z = wall.distance;
    before.world_from_view[3].z = wall.distance_before;
    const CameraData camera = camera_data(pose, &before, {.extent = wall.extent, .frame = 1});
    DenoiserInputs inputs = blank_inputs(wall.extent, camera);
    const float scale = wall.distance / wall.distance_before;  // of the wall's image, towards the previous frame
    for (unsigned y = 0; y < wall.extent.y; ++y)
        for (unsigned x = 0; x < wall.extent.x; ++x) {
            const glm::vec2 from_center = (glm::vec2(x, y) + 0.5f) / glm::vec2(wall.extent) - 0.5f;
            const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -wall.distance, 1);
            *inputs.depth.pixel(x, y) = clip.z / clip.w;
            inputs.normal.pixel(x, y)[2] = 1;
            *inputs.roughness.pixel(x, y) = std::round(wall.alpha * 255) / 255;
            for (int i = 0; i < 2; ++i) inputs.motion.pixel(x, y)[i] = from_center[i] * (1 - scale);
            for (int i = 0; i < 3; ++i) inputs.radiance.pixel(x, y)[i] = wall.color(x, y)[i];
        }
    for (float& tile : inputs.tiles.values) tile = 1;
    return inputs;
}

DenoiserInputs floor_and_ball(glm::uvec2 extent, DepthDirection direction, unsigned index, unsigned previous) {
    CameraPose pose, before;
    pose.world_from_view[3].x = 0.05f * float(index);
    before.world_from_view[3].x = 0.05f * float(previous);
    const CameraData camera =
        camera_data(pose, &before, {.extent = extent, .depth_direction = direction, .frame = index});
    DenoiserInputs inputs = blank_inputs(extent, camera);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            fill_pixel(inputs, camera_ray(pose, extent, glm::vec2(x, y) + 0.5f), x, y, index);
    return inputs;
}
