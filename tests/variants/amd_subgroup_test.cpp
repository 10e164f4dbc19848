#include "core/exr.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/variant_fixture.h"

#include <unistd.h>
#include <cstdlib>
#include <filesystem>

namespace {

constexpr glm::uvec2 extent{128, 96};

struct AmdSubgroups : VariantTest {
    /// Three frames of a held camera; rough pixels of most quads wait for a neighbour's ray in the first.
    HostImage radiance(const nlohmann::json& parameters) {
        PassGraph graph(device(), extent);
        const std::unique_ptr<Variant> variant = make_variant("amd_sssr", parameters);
        const CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
        Image image;
        for (unsigned frame = 0; frame < 3; ++frame) {
            const CameraData camera = camera_data(pose, &pose, {.extent = extent, .frame = frame});
            const GBuffer gbuffer = upload_gbuffer(graph, pose, camera, glossy_floor);
            graph.begin_frame(camera, variant->params, gbuffer.images());
            image = variant->render(graph, gbuffer).radiance;
        }
        return graph.download(image);
    }

    /// Without and with the early exit of subgroups that few rays are left of.
    LayeredImage images() {
        const HostImage finished = radiance({{"min_traversal_occupancy", 0}, {"barrier_before_average", true}});
        const HostImage given_up = radiance({{"min_traversal_occupancy", 4}, {"barrier_before_average", true}});
        return {.layers = {{"finished", "RGBA", finished}, {"given_up", "RGBA", given_up}}, .attributes = {}};
    }
};

/// Run by the test below, with subgroups of another size.
TEST_F(AmdSubgroups, DISABLED_WriteTheirImages) {
    const char* file = std::getenv("SSRLAB_TEST_OUTPUT");
    ASSERT_TRUE(file);
    write_exr(file, images());
}

/// lavapipe's subgroups have as many lanes as its vectors have floats: 4, 8 or 16.
TEST_F(AmdSubgroups, OfAnySizeGiveTheSameImages) {
    if (!device().info().is_cpu()) GTEST_SKIP() << "the size of this device's subgroups cannot be chosen";
    const LayeredImage expected = images();
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("ssrlab_subgroups_" + std::to_string(getpid()) + ".exr");
    unsigned given_up_differs = 0;
    for (const char* bits : {"128", "256", "512"}) {
        const std::string command = std::string("LP_NATIVE_VECTOR_WIDTH=") + bits +
                                    " SSRLAB_TEST_OUTPUT=" + file.string() + " " +
                                    std::filesystem::read_symlink("/proc/self/exe").string() +
                                    " --gtest_also_run_disabled_tests --gtest_filter='AmdSubgroups.DISABLED_*' >&2";
        ASSERT_EQ(std::system(command.c_str()), 0);
        const LayeredImage found = read_exr(file);
        std::filesystem::remove(file);
        EXPECT_TRUE(found.find("finished")->image.values == expected.find("finished")->image.values) << bits;
        given_up_differs += found.find("given_up")->image.values != expected.find("given_up")->image.values;
    }
    EXPECT_GE(given_up_differs, 2u);  // the sizes do differ: at least two of them are not this process's
}

}  // namespace
