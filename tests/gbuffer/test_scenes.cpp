#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
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
