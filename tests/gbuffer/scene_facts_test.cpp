#include "core/gbuffer/leading_vertices.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
#include <array>
#include <set>

TEST(scene_facts, of_a_scene_that_has_everything) {
    const Scene scene = varied_scene();
    const SceneFacts f = derive_facts(scene, scene.camera("main"), std::array{0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u});
    for (const bool fact : {f.has_geometry, f.has_reflective, f.camera_moves, f.objects_move, f.has_environment,
                            f.has_textures, f.has_alpha_masks, f.has_normal_maps})
        EXPECT_TRUE(fact);
    EXPECT_FALSE(f.is_still());
    EXPECT_FALSE(f.has_vertex_colors);
    EXPECT_EQ(f.max_roughness, 1.0f);
    EXPECT_EQ(list_facts(scene, f).size(), 14u);
    EXPECT_FALSE(f.hides_backs);
    Scene culled = scene;
    culled.draws_backs = false;
    EXPECT_TRUE(material_facts(culled).hides_backs);
}

TEST(scene_facts, deformed_meshes_move) {
    const Scene scene = deforming_scene();
    const SceneCamera& still = scene.camera("orthographic");
    EXPECT_TRUE(derive_facts(scene, still, std::array{3u, 4u}).objects_move);
    EXPECT_FALSE(derive_facts(scene, still, std::array{40u, 41u}).objects_move) << "behind the last key";
    for (const size_t channels : {2u, 1u}) {  // without the joints'
        Scene weights = scene;
        weights.animation.erase(weights.animation.begin(), weights.animation.begin() + long(channels));
        EXPECT_TRUE(derive_facts(weights, still, std::array{3u, 4u}).objects_move) << channels;
    }
}

TEST(scene_facts, only_what_is_drawn_counts) {
    Scene scene = varied_scene();
    scene.instances.resize(1);  // the floor, of roughness 0.2
    const SceneFacts f = derive_facts(scene, scene.camera("main"), std::array{0u});
    EXPECT_FLOAT_EQ(f.min_roughness, 0.2f);
    EXPECT_FLOAT_EQ(f.max_roughness, 0.2f);
    for (const bool fact : {f.has_textures, f.has_alpha_masks, f.has_normal_maps, f.camera_moves, f.objects_move})
        EXPECT_FALSE(fact);
    EXPECT_TRUE(f.is_still());
}

TEST(scene_facts, ranges_come_from_the_texels) {
    Scene scene = varied_scene();
    scene.instances = {scene.instances[1]};  // roughness texels 40 and 200
    const SceneFacts f = material_facts(scene);
    EXPECT_FLOAT_EQ(f.min_roughness, 40 / 255.0f);
    EXPECT_FLOAT_EQ(f.max_roughness, 200 / 255.0f);
}

TEST(scene_facts, nothing_is_reflective_without_specular) {
    Scene scene = varied_scene();
    scene.instances.resize(1);
    scene.materials[0].specular = 0;
    EXPECT_FALSE(material_facts(scene).has_reflective);
    scene.materials[0].metalness = 0.1f;
    EXPECT_TRUE(material_facts(scene).has_reflective);
}

/// Metalness of the texture's least texel counts, and what 8 bits round to 0 is none.
TEST(scene_facts, a_surface_is_matte_where_neither_factor_is_stored) {
    Scene scene = varied_scene();
    scene.instances = {scene.instances[1]};
    Material& material = scene.materials[scene.meshes[scene.instances[0].mesh].material];
    ASSERT_GE(material.metalness_roughness_texture.texture, 0);
    EXPECT_FALSE(material_facts(scene).has_matte);
    material.specular = 0.001f;
    material.metalness = 1;
    std::vector<uint8_t> texels(4 * 4, 200);
    Texture& texture = scene.textures[size_t(material.metalness_roughness_texture.texture)];
    for (const auto& [blue, is_matte] : {std::pair(uint8_t(1), false), {uint8_t(0), true}}) {
        texels[2] = blue;
        texture.rgba = std::make_shared<std::vector<uint8_t>>(texels);
        EXPECT_EQ(material_facts(scene).has_matte, is_matte) << int(blue);
    }
    material.specular = 0.5f;
    EXPECT_FALSE(material_facts(scene).has_matte);
    material.is_unlit = true;
    EXPECT_TRUE(material_facts(scene).has_matte);
}

TEST(leading_vertices, each_triangle_leads_with_a_vertex_of_its_own) {
    // A closed fan has more triangles than vertices that are free to lead.
    Mesh mesh{.vertices = std::vector<Vertex>(4)};
    for (int i = 0; i < 4; ++i) mesh.vertices[i].position = {i == 1, i == 2, i == 3};
    mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 1, 3, 2, 0, 1, 2};
    const LeadingVertices leading = find_leading_vertices(mesh);
    ASSERT_EQ(leading.indices.size(), mesh.indices.size());
    std::set<uint32_t> leaders;
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        leaders.insert(leading.indices[t]);
        glm::vec3 p[3];
        for (int c = 0; c < 3; ++c) p[c] = mesh.vertices[leading.source[leading.indices[t + c]]].position;
        const glm::vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        EXPECT_NEAR(glm::length(normal - leading.triangle_normal[leading.indices[t]]), 0, 1e-6f)
            << "triangle " << t / 3;
        glm::vec3 q[3];
        for (int c = 0; c < 3; ++c) q[c] = mesh.vertices[mesh.indices[t + c]].position;
        EXPECT_NEAR(glm::length(normal - glm::normalize(glm::cross(q[1] - q[0], q[2] - q[0]))), 0, 1e-6f)
            << "winding of triangle " << t / 3;
    }
    EXPECT_EQ(leaders.size(), mesh.indices.size() / 3);
}

TEST(pixel_facts, count_what_the_frame_shows) {
    HostGBuffer g;
    g.camera.depth = {0.1f, 10, 1, 0};
    g.depth = HostImage({2, 2}, 1, 0.5f);
    g.normal = HostImage({2, 2}, 4, 0.01f);
    g.base_color = g.emission = HostImage({2, 2}, 4);
    g.motion = HostImage({2, 2}, 2);
    g.depth.values[0] = 1;             // background
    g.emission.values[1 * 4 + 3] = 1;  // a dielectric
    g.normal.values[1 * 4 + 3] = 0.4f;
    g.base_color.values[2 * 4 + 3] = 1;  // a metal, a mirror, that moves
    g.motion.values[2 * 2] = 0.02f;
    const PixelFacts facts = pixel_facts(g);
    EXPECT_EQ(facts.background, 0.25f);
    EXPECT_EQ(facts.reflective, 0.5f);
    EXPECT_EQ(facts.mirror, 0.25f);
    EXPECT_EQ(facts.moving, 0.25f);
    EXPECT_EQ(facts.min_roughness, 0.01f);
    EXPECT_EQ(facts.max_roughness, 0.4f);
}
