#include "variants/common/lit_history.h"
#include "tests/variants/technique_fixture.h"

namespace {

struct LitHistories : TechniqueTest {
    PassList pass_list{device(), {5, 3}};
    ParameterSet no_parameters;

    /// Another colour in each pixel, and in each frame. Thirds are no halves: nothing is lost on the way.
    HostImage colors(unsigned frame) const {
        HostImage image(pass_list.extent(), 4);
        for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i + 100 * frame) / 3;
        return image;
    }
    Image begin(unsigned frame, Format format) {
        CameraData camera{};
        camera.frame = {frame, 0, 0, frame > 0};
        const Image lit = pass_list.image("lit", format);
        pass_list.upload(lit, colors(frame));
        pass_list.begin_frame(camera, no_parameters, std::array{lit});
        return lit;
    }
};

TEST_F(LitHistories, ShowTheFrameBeforeAndAtFirstTheirOwn) {
    LitHistory history;
    for (unsigned frame = 0; frame < 5; ++frame) {
        const Image lit = begin(frame, Format::rgba32f);
        EXPECT_EQ(pass_list.download(history.previous(pass_list, lit)).values,
                  colors(frame > 0 ? frame - 1 : 0).values);
        EXPECT_EQ(pass_list.download(lit).values, colors(frame).values) << frame;
    }
}

TEST_F(LitHistories, KeepTheFormatOfTheLitImage) {
    LitHistory history;
    for (unsigned frame = 0; frame < 2; ++frame)
        EXPECT_EQ(history.previous(pass_list, begin(frame, Format::rgba16f)).format, Format::rgba16f);
}

// After a change of size there is a new pass_list, whose history holds nothing: the first frame shows its own colour
// again.
TEST_F(LitHistories, BeginAnewInAnotherGraph) {
    LitHistory history;
    history.previous(pass_list, begin(0, Format::rgba32f));
    PassList larger(device(), {7, 5});
    const Image lit = larger.image("lit", Format::rgba32f);
    larger.upload(lit, HostImage({7, 5}, 4, 3.0f));
    CameraData camera{};
    camera.frame = {1, 0, 0, 1};
    larger.begin_frame(camera, no_parameters, std::array{lit});
    EXPECT_EQ(larger.download(history.previous(larger, lit)).values[0], 3.0f);
}

}  // namespace
