#include "tests/gbuffer/agreement.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/scene_facts.h"
#include "core/scene/load_scene.h"

#include <gtest/gtest.h>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

namespace {

struct Case {
    const char* name;
    const char* camera;
    unsigned frame;
    DepthDirection direction;
    DepthFormat format;
};

const Case cases[] = {
    {"perspective", "main", 0, DepthDirection::standard, DepthFormat::d32f},
    {"reversed, moving", "main", 7, DepthDirection::reversed, DepthFormat::d32f},
    {"d24, moving", "main", 12, DepthDirection::standard, DepthFormat::d24},
    {"d24 reversed, moving", "main", 20, DepthDirection::reversed, DepthFormat::d24},
    {"d16", "main", 0, DepthDirection::standard, DepthFormat::d16},
    {"d16 reversed", "main", 0, DepthDirection::reversed, DepthFormat::d16},
    {"orthographic", "orthographic", 5, DepthDirection::standard, DepthFormat::d32f},
    {"orthographic reversed", "orthographic", 5, DepthDirection::reversed, DepthFormat::d32f},
};

}  // namespace

class agreement : public testing::TestWithParam<Case> {};

TEST_P(agreement, with_rays_through_pixel_centres) {
    const Scene scene = varied_scene();
    const Case c = GetParam();
    if (c.format == DepthFormat::d24 && !test_device().supports(Format::d24)) GTEST_SKIP() << "the device has no D24";
    expect_agreement(compare_with_rays(scene, scene.camera(c.camera), view_of({317, 241}, c.frame, c.direction),
                                       {.depth_format = c.format}),
                     c.name);
}
INSTANTIATE_TEST_SUITE_P(varied_scene, agreement, testing::ValuesIn(cases));

/// Textures of 16 bits, whose lower bytes no 8 bits could have.
TEST(agreement, textures_of_16_bits_are_the_same_in_both_renderers) {
    Scene scene = varied_scene();
    for (Texture& texture : scene.textures) {
        std::vector<uint8_t> wide(2 * texture.rgba->size());
        for (size_t i = 0; i < texture.rgba->size(); ++i) {
            const uint8_t high = (*texture.rgba)[i];
            const auto code = uint16_t(high == 255 ? 65535 : high == 0 ? 0 : high * 256 + (i * 101) % 256);
            std::memcpy(&wide[2 * i], &code, sizeof code);
        }
        texture.rgba = make_texels(std::move(wide)), texture.channel_bytes = 2;
    }
    expect_agreement(compare_with_rays(scene, scene.camera("main"), view_of({160, 90})), "16 bits");
}

/// The roughness of one texel, 6808 / 65535, but for the rounding of the filter: 8 bits would make 0.10196 of it.
TEST(agreement, roughness_of_16_bits_is_kept) {
    Scene scene = varied_scene();
    std::vector<uint8_t> rgba(8);
    const uint16_t codes[] = {0, 6808, 0, 65535};
    std::memcpy(rgba.data(), codes, sizeof codes);
    scene.textures = {{.extent = {1, 1}, .rgba = make_texels(rgba), .channel_bytes = 2}};
    scene.materials = {{.metalness_roughness_texture = {0}}};
    scene.instances.resize(1);
    const FrameView view = view_of({16, 9});
    Rasterizer rasterizer(test_device(), scene, {.extent = view.extent});
    const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view);
    const HostGBuffer g = download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f);
    size_t seen = 0;
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        if (g.material_id.values[i] == 0) continue;
        ++seen;
        EXPECT_FLOAT_EQ(g.normal.values[4 * i + 3], 6808 / 65535.0f);
    }
    EXPECT_GT(seen, 20u);
    EXPECT_FLOAT_EQ(material_facts(scene).min_roughness, 6808 / 65535.0f);
}

TEST(agreement, of_what_joints_and_morph_targets_deform) {
    const Scene scene = deforming_scene();
    for (const unsigned frame : {0u, 17u})
        expect_agreement(compare_with_rays(scene, scene.camera("orthographic"), view_of({317, 241}, frame)),
                         "deformed, frame " + std::to_string(frame));
    Scene mirrored = scene;
    for (Node& node : mirrored.nodes)
        if (node.name == "hip") node.parent_from_node = glm::mat4(1), node.parent_from_node[0][0] = -1;
    mirrored.animation.clear();
    expect_agreement(compare_with_rays(mirrored, scene.camera("main"), view_of({317, 241}, 0)), "deformed, mirrored");
}

TEST(agreement, keep_all_shaders_see_the_same) {
    const Scene scene = varied_scene();
    expect_agreement(compare_with_rays(scene, scene.camera("main"), view_of({160, 90}), {.keep_all = true}),
                     "keep all");
}

TEST(agreement, of_dielectrics_with_reflectances_of_their_own) {
    const Scene scene = dielectric_scene();
    for (const bool keeps_all : {false, true})
        expect_agreement(compare_with_rays(scene, scene.camera("main"), view_of({160, 90}), {.keep_all = keeps_all}),
                         "dielectrics");
}

TEST(agreement, flattened_nodes_have_the_normals_of_what_they_are_flattened_to) {
    Scene scene = varied_scene();
    scene.animation.clear();
    for (unsigned i = 1; i < 4; ++i) {  // tilted quads: textured, masked, normal-mapped; the second is mirrored too
        glm::mat4& matrix = scene.nodes[scene.instances[i].node].parent_from_node;
        matrix = glm::scale(glm::mat4(1), glm::vec3(i == 2 ? -1 : 1, 1, 0)) * matrix;
        matrix[3] += glm::vec4(0, 0, -3 - 0.1f * float(i), 0);
    }
    const FrameView view = view_of({160, 90});
    expect_agreement(compare_with_rays(scene, scene.camera("main"), view), "flattened");
    Rasterizer rasterizer(test_device(), scene, {.extent = view.extent});
    const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view);
    EXPECT_TRUE(
        count_non_finite(download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f))
            .empty());
}

TEST(agreement, a_quarter_of_a_pixel_is_noticed) {
    const Scene scene = varied_scene();
    FrameView view = view_of({160, 90});
    view.jitter = {0.25f, 0.25f};
    const Agreement a = compare_with_rays(scene, scene.camera("main"), view);
    EXPECT_LT(a.depth, 0.7 * a.compared);
}

/// Scenes of the repository: every procedural one whose geometry differs from the others in kind.
class scene_agreement : public testing::TestWithParam<const char*> {};

TEST_P(scene_agreement, with_rays_through_pixel_centres) {
    const Scene scene = load_scene(GetParam(), scene_search_path());
    for (const SceneCamera& camera : scene.cameras) {
        const unsigned frame = camera.frame_count / 2;
        expect_agreement(compare_with_rays(scene, camera, view_of({240, 135}, frame, DepthDirection::reversed)),
                         scene.name + ", " + camera.name);
    }
}
INSTANTIATE_TEST_SUITE_P(procedural, scene_agreement,
                         testing::Values("mirror_pillars", "roughness_gradient", "grazing", "fence", "floating_holes",
                                         "offscreen_mirror", "curved_mirror", "axis_parallel", "depth_range",
                                         "normal_mapped", "moving_objects", "all_rough", "sky_only", "furnace"));
