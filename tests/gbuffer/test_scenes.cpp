#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstring>

namespace {

Texture checker(const char* name, bool is_srgb, glm::u8vec4 even, glm::u8vec4 odd) {
    std::vector<uint8_t> rgba;
    for (unsigned y = 0; y < 7; ++y)
        for (unsigned x = 0; x < 9; ++x)
            for (int c = 0; c < 4; ++c) rgba.push_back(((x + y) % 2 ? odd : even)[c]);
    return {.name = name, .extent = {9, 7}, .rgba = make_texels(std::move(rgba)), .is_srgb = is_srgb};
}

void add(Scene& scene, const Mesh& mesh, const glm::mat4& world_from_object = glm::mat4(1)) {
    scene.nodes.push_back({.name = mesh.name, .parent_from_node = world_from_object});
    scene.instances.push_back({unsigned(scene.meshes.size()), unsigned(scene.nodes.size() - 1)});
    scene.meshes.push_back(mesh);
}

}  // namespace

Mesh quad(unsigned material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    const glm::vec4 tangent(glm::normalize(u), 1);
    Mesh mesh{.name = "quad", .indices = {0, 1, 2, 0, 2, 3}, .material = material};
    for (const glm::vec2 p : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        mesh.vertices.push_back({corner + p.x * u + p.y * v, normal, tangent, {p, 3.0f * p}, glm::vec4(1)});
    return mesh;
}

Scene varied_scene() {
    Scene scene{.name = "varied"};
    scene.textures = {checker("color", true, {255, 40, 30, 255}, {20, 90, 250, 255}),
                      checker("mask", true, {255, 255, 255, 255}, {255, 255, 255, 0}),
                      checker("bumps", false, {150, 110, 240, 255}, {100, 140, 235, 255}),
                      checker("rough", false, {0, 40, 255, 255}, {0, 200, 0, 255})};
    scene.textures[1].wrap_u = TextureWrap::mirrored_repeat;
    scene.textures[2].wrap_v = TextureWrap::clamp_to_edge;
    scene.textures[3].is_nearest = true;
    scene.materials = {
        {.name = "floor", .base_color = glm::vec3(0.5f), .metalness = 0, .roughness = 0.2f},
        {.name = "textured", .base_color_texture = {0, 1}, .metalness_roughness_texture = {3}},
        {.name = "masked",
         .base_color_texture = {1},
         .metalness = 0,
         .roughness = 0.02f,
         .alpha_mode = AlphaMode::mask,
         .is_double_sided = true},
        {.name = "bumpy", .metalness = 1, .roughness = 0.3f, .normal_texture = {2}, .normal_scale = 0.7f},
        {.name = "lamp", .emission = {3, 2, 1}, .specular = 0.5f},
        {.name = "unlit", .base_color = {0.2f, 0.8f, 0.3f}, .is_unlit = true}};
    scene.materials[2].base_color_texture.uv_transform = glm::mat3(1.5f, 0.5f, 0, -0.5f, 1.5f, 0, 0.1f, 0.2f, 1);
    add(scene, quad(0, {-6, 0, 4}, {12, 0, 0}, {0, 0, -14}));
    add(scene, quad(1, {-3, 0.2f, -3}, {2, 0, 0}, {0, 2, 0.5f}));
    add(scene, quad(2, {-0.7f, 0.4f, -2}, {1.6f, 0, -0.4f}, {0, 1.7f, 0}));
    add(scene, quad(3, {1.2f, 0.3f, -3}, {2, 0, 0.3f}, {0, 2, 0}));
    add(scene, quad(3, {1.2f, 2.6f, -3}, {2, 0, 0.3f}, {0, 1, 0}),
        glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1));
    add(scene, quad(4, {-0.5f, 2.7f, -4}, {1, 0, 0}, {0, 0.6f, 0.2f}));
    add(scene, quad(5, {3.6f, 0, -4}, {1, 0, 0}, {0, 1, 0}));
    scene.animation = {{.property = AnimationChannel::Property::translation,
                        .node = 1,
                        .times = {0, 1},
                        .values = {glm::vec4(0), glm::vec4(6, 0, 1, 0)}}};
    scene.lights = {{.name = "lamp", .intensity = glm::vec3(20), .position = {0, 4, 1}},
                    {.name = "sun",
                     .type = LightType::directional,
                     .intensity = glm::vec3(2),
                     .direction = glm::normalize(glm::vec3(1, -2, -1))},
                    {.name = "spot",
                     .type = LightType::spot,
                     .intensity = glm::vec3(30),
                     .range = 9,
                     .inner_cone_cos = 0.95f,
                     .outer_cone_cos = 0.8f,
                     .position = {-4, 3, 2},
                     .direction = glm::normalize(glm::vec3(1, -0.5f, -1))}};
    scene.environment = {.type = Environment::Type::constant, .color = {0.4f, 0.5f, 0.6f}};
    scene.cameras = {{.name = "main",
                      .vertical_fov = 0.9f,
                      .near = 0.1f,
                      .far = 50,
                      .keys = {{0, {0, 1.6f, 3}, {0, 1, -3}}, {30, {2, 2.6f, 2}, {0, 1, -3}}},
                      .frame_count = 30},
                     {.name = "orthographic",
                      .is_orthographic = true,
                      .orthographic_height = 5,
                      .near = 0.1f,
                      .far = 50,
                      .keys = {{0, {1, 3, 4}, {0, 1, -3}}}}};
    scene.frame_count = 30;
    return scene;
}

Scene dielectric_scene() {
    Scene scene = varied_scene();
    scene.materials[0].dielectric_f0 = 0.1724f;  // an index of refraction of 2.42
    Material& textured = scene.materials[1];
    textured.dielectric_f0 = 1.0f, textured.specular_color = {2.0f, 0.5f, 0.1f};
    textured.specular_color_texture = {0, 1};
    textured.metalness = 0.5f;
    scene.materials[2].specular_texture = {3};  // whose alpha is 1
    scene.materials[2].specular_texture.uv_transform = glm::mat3(2.0f);
    scene.materials[3].specular_texture = {1}, scene.materials[3].metalness = 0;
    scene.materials[4].dielectric_f0 = 0.0201f;
    return scene;
}

Scene deforming_scene() {
    Scene scene = varied_scene();
    const auto first = unsigned(scene.nodes.size());
    Node hip{.name = "hip"}, knee{.name = "knee", .parent = int(first)};
    hip.translation = {0, 0.1f, -0.2f}, knee.translation = {0.3f, 0.2f, 0};
    for (Node* node : {&hip, &knee}) {
        node->parent_from_node[3] = glm::vec4(node->translation, 1);
        scene.nodes.push_back(*node);
    }
    scene.skins = {{.joints = {first, first + 1}, .joint_from_mesh = {glm::mat4(1), glm::mat4(1)}}};
    scene.skins[0].joint_from_mesh[1][3] = {0, -0.2f, 0, 1};
    scene.animation.clear();
    const auto animate = [&](AnimationChannel::Property property, unsigned node, glm::vec4 from, glm::vec4 to) {
        scene.animation.push_back({.property = property, .node = node, .times = {0, 1}, .values = {from, to}});
    };
    animate(AnimationChannel::Property::translation, first, glm::vec4(hip.translation, 0), {0.4f, 0.3f, 0.5f, 0});
    animate(AnimationChannel::Property::rotation, first + 1, {0, 0, 0, 1}, {0.1f, 0.3f, 0, std::sqrt(0.9f)});
    for (const unsigned i : {1u, 3u}) {
        scene.instances[i].skin = 0;
        scene.nodes[scene.instances[i].node].weights = {0};
        animate(AnimationChannel::Property::weight, scene.instances[i].node, {0.1f, 0, 0, 0}, {1, 0, 0, 0});
    }

    Mesh& flat = scene.meshes[scene.instances[1].mesh];
    flat.targets = {{.positions = std::vector<glm::vec3>(4, {0.2f, 0.5f, 0.3f})}};
    flat.joints_per_vertex = 2;
    for (int i = 0; i < 4; ++i)
        flat.joint_weights.insert(flat.joint_weights.end(),
                                  {{.joint = 0, .weight = 0.25f}, {.joint = 1, .weight = 0.75f}});

    Mesh& grid = scene.meshes[scene.instances[3].mesh];
    const std::vector<Vertex> corner = grid.vertices;
    constexpr unsigned side = 16;
    grid.vertices.clear(), grid.indices.clear();
    grid.targets = {{}}, grid.joints_per_vertex = 2;
    const float pi = 3.14159265f;
    for (unsigned y = 0; y <= side; ++y)
        for (unsigned x = 0; x <= side; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / float(side);
            Vertex vertex = corner[0];
            vertex.position +=
                uv.x * (corner[1].position - corner[0].position) + uv.y * (corner[3].position - corner[0].position);
            vertex.uv[0] = uv;
            grid.vertices.push_back(vertex);
            grid.targets[0].positions.push_back(0.2f * std::sin(pi * uv.x) * std::sin(pi * uv.y) * vertex.normal);
            grid.targets[0].normals.push_back({-0.3f * std::cos(pi * uv.x), -0.3f * std::cos(pi * uv.y), 0});
            grid.targets[0].tangents.push_back({0, 0, 0.3f * std::cos(pi * uv.x)});
            grid.joint_weights.insert(grid.joint_weights.end(),
                                      {{.joint = 0, .weight = 1 - uv.y}, {.joint = 1, .weight = uv.y}});
            if (x == side || y == side) continue;
            const unsigned at = y * (side + 1) + x, above = at + side + 1;
            grid.indices.insert(grid.indices.end(), {at, at + 1, above + 1, at, above + 1, above});
        }
    return scene;
}

Device& test_device() {
    static Device device;
    return device;
}

FrameView view_of(glm::uvec2 extent, unsigned frame, DepthDirection direction) {
    return {.extent = extent, .depth_direction = direction, .frame = frame};
}

size_t differing_bits(const HostImage& a, const HostImage& b) {
    if (a.extent != b.extent || a.channels != b.channels) return std::max(a.values.size(), b.values.size());
    size_t count = 0;
    for (size_t i = 0; i < a.values.size(); ++i) count += std::memcmp(&a.values[i], &b.values[i], sizeof(float)) != 0;
    return count;
}

namespace {
/// Fails the program's run if any test made the validation layer report anything.
class ValidationIsSilent : public testing::Environment {
    void TearDown() override { EXPECT_EQ(test_device().validation_messages(), std::vector<std::string>{}); }
};
testing::Environment* const validation = testing::AddGlobalTestEnvironment(new ValidationIsSilent);
}  // namespace
