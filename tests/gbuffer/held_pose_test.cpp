// Frames whose poses do not count up by one: held, first of a row, and jumping.
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>

namespace {

struct Row {
    const Scene scene = varied_scene();
    Rasterizer rasterizer{test_device(), scene, {.extent = {91, 77}}};

    HostGBuffer render(unsigned pose, unsigned index, unsigned previous) {
        FrameView view = view_of({91, 77}, pose);
        view.index = index, view.previous_frame = previous;
        const GBuffer g = rasterizer.render(scene.camera("main"), view);
        return download_gbuffer(rasterizer.pass_list(), g, rasterizer.camera(), DepthFormat::d32f);
    }
};

}  // namespace

TEST(held_pose, does_not_move) {
    Row row;
    const HostGBuffer first = row.render(5, 0, 0), second = row.render(5, 1, 5), third = row.render(5, 2, 5);
    EXPECT_EQ(first.camera.frame.w, 0u);
    EXPECT_EQ(second.camera.frame.w, 1u);
    EXPECT_EQ(third.camera.frame.x, 2u);
    EXPECT_EQ(third.camera.previous_clip_from_world, third.camera.clip_from_world);
    for (const HostGBuffer* g : {&first, &second, &third}) {
        for (const float motion : g->motion.values) ASSERT_EQ(motion, 0.0f);
        EXPECT_EQ(differing_bits(g->previous_depth, g->depth), 0u);
        EXPECT_EQ(differing_bits(g->depth, first.depth), 0u);
    }
}

TEST(held_pose, jumps_by_the_whole_way) {
    Row row;
    row.render(4, 0, 0);
    const HostGBuffer jumped = row.render(8, 1, 4);
    // The same jump without having rendered frame 4 just before: it is drawn first.
    Row other;
    const HostGBuffer alone = other.render(8, 1, 4);
    EXPECT_EQ(differing_bits(jumped.motion, alone.motion), 0u);
    EXPECT_EQ(differing_bits(jumped.previous_depth, alone.previous_depth), 0u);

    // Four frames of a path that is linear in the frame number move a surface about four times as far as one does.
    const HostGBuffer step = other.render(8, 1, 7);
    const auto mean_length = [](const HostGBuffer& g) {
        double sum = 0;
        for (size_t i = 0; i < g.motion.pixel_count(); ++i)
            sum += glm::length(glm::vec2(g.motion.values[2 * i], g.motion.values[2 * i + 1]));
        return sum / double(g.motion.pixel_count());
    };
    // Perspective bends the screen path of a point: a tenth covers it.
    EXPECT_NEAR(mean_length(jumped) / mean_length(step), 4.0, 0.4);
}
