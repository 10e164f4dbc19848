#include "tests/variants/amd_scenes.h"
#include "tests/variants/other_subgroups.h"
#include "tests/variants/technique_fixture.h"

namespace {

constexpr glm::uvec2 extent{128, 96};

struct AmdSubgroups : TechniqueTest {
    /// Three frames of a held camera; rough pixels of most quads wait for a neighbour's ray in the first.
    HostImage radiance(const nlohmann::json& parameters) {
        PassList pass_list(device(), extent);
        const std::unique_ptr<Technique> technique = make_technique("amd_sssr", parameters);
        const CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
        Image image;
        for (unsigned frame = 0; frame < 3; ++frame) {
            const CameraData camera = camera_data(pose, &pose, {.extent = extent, .frame = frame});
            const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, glossy_floor);
            pass_list.begin_frame(camera, technique->params, gbuffer.images());
            image = technique->render(pass_list, gbuffer).radiance;
        }
        return pass_list.download(image);
    }

    /// Of both forms of the denoiser; and with the early exit of subgroups that few rays are left of.
    LayeredImage images() {
        const HostImage fast = radiance({{"hierarchy.min_traversal_occupancy", 0}}),
                        faithful = radiance({{"hierarchy.min_traversal_occupancy", 0},
                                             {"denoiser_form", "faithful"},
                                             {"barrier_before_average", true}}),
                        given_up = radiance({{"hierarchy.min_traversal_occupancy", 4}});
        return {.layers = {{"fast", "RGBA", fast}, {"faithful", "RGBA", faithful}, {"given_up", "RGBA", given_up}},
                .attributes = {}};
    }
};

/// Run by the test below, with subgroups of another size.
TEST_F(AmdSubgroups, DISABLED_WriteTheirImages) { write_for_caller(images()); }

TEST_F(AmdSubgroups, OfAnySizeGiveTheSameImages) {
    if (!device().info().is_cpu()) GTEST_SKIP() << "the size of this device's subgroups cannot be chosen";
    const LayeredImage expected = images();
    unsigned given_up_differs = 0;
    for (const char* bits : vector_widths) {
        const LayeredImage found = written_with_vectors_of(bits, "AmdSubgroups.DISABLED_*");
        const auto differs = [&](const char* layer) {
            return found.find(layer)->image.values != expected.find(layer)->image.values;
        };
        EXPECT_FALSE(differs("fast")) << bits;
        EXPECT_FALSE(differs("faithful")) << bits;
        given_up_differs += differs("given_up");
    }
    EXPECT_GE(given_up_differs, 2u);  // the sizes do differ: at least two of them are not this process's
}

}  // namespace
