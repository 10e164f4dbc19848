#include "variants/common/lit_history.h"
#include "tests/variants/variant_fixture.h"

namespace {

struct LitHistories : VariantTest {
    PassGraph graph{device(), {5, 3}};
    ParameterSet no_parameters;

    /// Of one value; another one in each frame.
    Image begin(unsigned frame, float value, Format format) {
        CameraData camera{};
        camera.frame = {frame, 0, 0, frame > 0};
        const Image lit = graph.image("lit", format);
        graph.upload(lit, HostImage(graph.extent(), 4, value));
        graph.begin_frame(camera, no_parameters, std::array{lit});
        return lit;
    }
    float shown(const Image& image) {
        const HostImage pixels = graph.download(image);
        for (const float value : pixels.values) EXPECT_EQ(value, pixels.values[0]);
        return pixels.values[0];
    }
};

/// Thirds are no halves: nothing is lost on the way.
TEST_F(LitHistories, ShowTheFrameBeforeAndAtFirstTheirOwn) {
    LitHistory history;
    for (unsigned frame = 0; frame < 5; ++frame) {
        const Image lit = begin(frame, float(frame + 1) / 3, Format::rgba32f);
        EXPECT_EQ(shown(history.previous(graph, lit)), float(std::max(frame, 1u)) / 3) << frame;
        EXPECT_EQ(shown(lit), float(frame + 1) / 3);
    }
}

TEST_F(LitHistories, KeepTheFormatOfTheLitImage) {
    LitHistory history;
    for (unsigned frame = 0; frame < 2; ++frame)
        EXPECT_EQ(history.previous(graph, begin(frame, 0.5f, Format::rgba16f)).format, Format::rgba16f);
}

}  // namespace
