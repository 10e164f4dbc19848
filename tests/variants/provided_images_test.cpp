// What writers of shaders are told of the images that a technique can read.
#include "variants/passes/provided_images.h"
#include "core/gbuffer/gbuffer_images.h"
#include "core/gpu/format.h"
#include "tests/variants/technique_fixture.h"

namespace {

struct ProvidedImagesTest : TechniqueTest {};

TEST_F(ProvidedImagesTest, HaveTheFormatsThatAreStated) {
    PassList pass_list(device(), {16, 9});
    const auto technique = make_technique("frostbite_sssr");  // whose parameters `below_horizon` needs
    const GBuffer gbuffer{.depth = pass_list.image("depth", Format::r32f),
                          .lit = pass_list.image("lit", Format::rgba32f)};
    pass_list.clear(gbuffer.depth, glm::vec4(1)), pass_list.clear(gbuffer.lit, glm::vec4(0));
    CameraData camera{};
    camera.extent = {16, 9, 1.0f / 16, 1.0f / 9};
    pass_list.begin_frame(camera, technique->params, std::array{gbuffer.depth, gbuffer.lit});
    ProvidedImages provided;
    const std::vector<ProvidedImage> described = ProvidedImages::described();
    EXPECT_EQ(described.size() + gbuffer_images().size(), ProvidedImages::names().size());
    for (const ProvidedImage& image : described) {
        EXPECT_TRUE(ProvidedImages::has(image.name));
        EXPECT_EQ(name_of(provided.image(pass_list, gbuffer, image.name, technique->params).format), image.format)
            << image.name;
    }
}

}  // namespace
