#include "core/scene/scene.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/animation.h"
#include "core/scene/deform.h"
#include "core/scene/ranges.h"
#include "core/scene/transform.h"
#include "core/shared/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

/// Bilinear between texel centres; u (0 to 1) wraps, v clamps.
glm::vec3 bilinear(const HostImage& image, glm::vec2 uv) {
    const int width = int(image.extent.x), height = int(image.extent.y);
    const glm::vec2 texel = uv * glm::vec2(image.extent) - 0.5f;
    const glm::vec2 base = glm::floor(texel);
    const glm::vec2 weight = texel - base;
    const auto fetch = [&](int x, int y) {
        const int column = x < 0 ? width - 1 : x < width ? x : 0;
        const float* rgb = image.pixel(unsigned(column), unsigned(std::clamp(y, 0, height - 1)));
        return glm::vec3(rgb[0], rgb[1], rgb[2]);
    };
    const int x = int(base.x), y = int(base.y);
    return glm::mix(glm::mix(fetch(x, y), fetch(x + 1, y), weight.x),
                    glm::mix(fetch(x, y + 1), fetch(x + 1, y + 1), weight.x), weight.y);
}

}  // namespace

const SceneCamera& Scene::camera(const std::string& wanted) const {
    if (cameras.empty()) fail("scene '", name, "' has no camera; add one to its file");
    if (wanted.empty()) return cameras.front();
    return find_named(cameras, wanted, "scene '", name, "' has no camera");
}

bool Scene::hides_backs() const {
    return std::ranges::any_of(
        instances, [&](const Instance& instance) { return hides_backs_of(materials[meshes[instance.mesh].material]); });
}

size_t Scene::triangle_count() const {
    size_t count = 0;
    for (const Instance& instance : instances) count += meshes[instance.mesh].indices.size() / 3;
    return count;
}

namespace {
std::vector<Node> animated_nodes(const Scene& scene, float time) {
    std::vector<Node> nodes = scene.nodes;
    for (const AnimationChannel& channel : scene.animation) {
        Node& node = nodes[channel.node];
        const glm::vec4 value = sample_channel(channel, time);
        switch (channel.property) {
            case AnimationChannel::Property::translation:
                node.translation = value;
                break;
            case AnimationChannel::Property::rotation:
                node.rotation = value;
                break;
            case AnimationChannel::Property::scale:
                node.scale = value;
                break;
            case AnimationChannel::Property::weight:
                node.weights[channel.target] = value.x;
                continue;
        }
        node.parent_from_node = transform(node.translation, node.rotation, node.scale);
    }
    return nodes;
}

/// KHR_lights_punctual: a light shines along -z of its node and ignores the node's scale.
PunctualLight posed_light(PunctualLight light, const std::vector<glm::mat4>& world_from_node) {
    if (light.node < 0) return light;
    const glm::mat4& world_from_light = world_from_node[size_t(light.node)];
    light.position = world_from_light[3];
    if (light.type == LightType::point) return light;
    const glm::dvec3 axis(world_from_light[2]);
    if (!(glm::length(axis) > 0.0))
        fail("light '", light.name, "' hangs on a node with a scale of 0: it has no direction");
    light.direction = -glm::vec3(glm::normalize(axis));
    return light;
}
}  // namespace

ScenePose pose_scene(const Scene& scene, float frame) {
    ScenePose pose;
    const std::vector<Node> nodes =
        scene.animation.empty() ? scene.nodes : animated_nodes(scene, frame / scene.frame_rate);
    for (const Node& node : nodes) {
        pose.world_from_node.push_back(node.parent < 0
                                           ? node.parent_from_node
                                           : pose.world_from_node[size_t(node.parent)] * node.parent_from_node);
        if (!is_in_range(pose.world_from_node.back()))
            fail("scene '", scene.name, "': at frame ", frame, " animation moves node '", shortened(node.name),
                 "' beyond +-", any_length, " m, or scales it by more");
    }
    for (const Instance& instance : scene.instances)
        pose.world_from_instance.push_back(pose.world_from_node[instance.node]);
    add_deformations(scene, nodes, pose);
    for (const PunctualLight& light : scene.lights) pose.lights.push_back(posed_light(light, pose.world_from_node));
    return pose;
}

std::array<glm::vec3, 2> scene_bounds(const Scene& scene, const ScenePose& pose) {
    const float infinity = std::numeric_limits<float>::infinity();
    glm::vec3 low(infinity), high(-infinity);
    std::vector<Vertex> deformed;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const std::span<const Vertex> vertices = posed_vertices(scene, pose, i, deformed);
        for (const uint32_t index : scene.meshes[scene.instances[i].mesh].indices) {
            const glm::vec3 position = pose.world_from_instance[i] * glm::vec4(vertices[index].position, 1.0f);
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
    }
    if (low.x > high.x) return {glm::vec3(0.0f), glm::vec3(0.0f)};
    return {low, high};
}

bool Environment::is_black() const {
    switch (type) {
        case Type::constant:
            return color == glm::vec3(0.0f);
        // The radiance is largest along +axis or -axis.
        case Type::gradient:
            return glm::max(color + glm::abs(slope), glm::vec3(0.0f)) == glm::vec3(0.0f);
        case Type::image:
            return std::ranges::all_of(latlong.values, [](float value) { return value == 0.0f; });
    }
    return true;
}

glm::vec3 Environment::radiance(glm::vec3 direction) const {
    switch (type) {
        case Type::constant:
            return color;
        case Type::gradient:
            return glm::max(color + slope * glm::dot(direction, axis), glm::vec3(0.0f));
        case Type::image:
            return image_radiance(environment_uv(direction, rotation));
    }
    return glm::vec3(0.0f);
}

glm::vec3 Environment::image_radiance(glm::vec2 uv) const { return bilinear(latlong, uv); }
