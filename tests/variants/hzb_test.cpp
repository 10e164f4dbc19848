#include "tests/variants/mirror_scenes.h"
#include "tests/variants/tracer_walls_fixture.h"

// The parameters of the tracer hzb, one by one.

namespace {

struct Hzb : TracerAtWall {
    BenchEnd trace(const BenchRay& ray, const nlohmann::json& parameters = nlohmann::json::object()) {
        return bench.trace("hzb", ray, parameters);
    }
    /// It falls behind the column half a metre deep, and meets the wall, 100 pixels farther.
    BenchRay behind_column() const { return bench.ray_to(start, {column + 40, 40.5f}, 10.001f); }
};

TEST_F(Hzb, MeetsTheColumn) {
    const BenchEnd end = trace(to_column());
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_EQ(end.pixel, glm::ivec2(column, start.y));
    EXPECT_NEAR(end.position.x, column, 0.01);  // its wall and the overshoot of 0.005 pixels
    EXPECT_NEAR(end.distance, to_column_meters(float(column) - start.x - 0.5f), 1e-3);
    EXPECT_EQ(end.confidence, 1);
}

/// Infinity less infinity, on the middle column of the screen, exactly. Of a ray along that column minimum() may drop
/// what is no number; of one along the view nothing else is left.
TEST_F(Hzb, GuardsZeroDirections) {
    bench.view.extent = {65, 65};  // whose middle, 32.5 / 65, float has without rounding
    bench.show_wall(10);
    for (unsigned x = 0; x < 65; ++x) bench.set_pixel({x, 10}, 5, glm::normalize(glm::vec3(0, -1, 1)));
    bench.set_pixel({32, 60}, 5.02f, {0, 1, 0});
    bench.set_pixel({32, 32}, 5.02f, {0, 1, 0});
    const BenchEnd up = trace({{32, 60}, {0, 1, 0}});
    EXPECT_TRUE(up.is_hit()) << up;
    EXPECT_EQ(up.pixel, glm::ivec2(32, 10));
    const BenchRay along_view{{32, 32}, {0, 0, -1}};
    const BenchEnd end = trace(along_view), printed = trace(along_view, {{"hzb.guard_zero_direction", false}});
    EXPECT_EQ(end.outcome, outcome_own_surface) << end;
    EXPECT_EQ(end.position, glm::vec2(32.5f));
    EXPECT_NE(printed.position, glm::vec2(32.5f));
}

/// Half a metre before the camera a step of one metre back ends behind it, from where the ray's line runs the other
/// way.
TEST_F(Hzb, ScalesTheStepBeforeTheCamera) {
    bench.show(mirror_beside_wall);
    std::vector<BenchRay> rays;  // from the mirror to the wall, back towards the camera
    for (unsigned y = 20; y < 60; y += 4) rays.push_back({{110, y}, {0.8f, 0, 0.6f}});
    ASSERT_NEAR(bench.position({110, 40}).z, -0.5f, 1e-3);
    EXPECT_EQ(hits("hzb", rays), rays.size());
    EXPECT_EQ(hits("hzb", rays, {{"hzb.scale_step", false}}), 0u);
}

/// A ray from the wall, nearer and nearer, to a column before it: the depth of what is behind the ray lies in its past.
TEST_F(Hzb, GoesToWallsOnlyTowardsTheCamera) {
    const BenchRay ray = bench.ray_to({21, 40}, {column + 0.5f, 40.5f}, 5.01f);
    const BenchEnd end = trace(ray), by_depth = trace(ray, {{"hzb.walls_only_towards_camera", false}});
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_EQ(end.pixel, glm::ivec2(column, 40));
    EXPECT_FALSE(by_depth.is_hit());
}

/// The last column of odd sizes has no texels on the next level; 0 is the far plane there.
TEST_F(Hzb, LooksAtPartialTexelsOnFinerLevels) {
    bench.view.extent = {201, 81};
    bench.view.depth_direction = DepthDirection::reversed;
    bench.show_wall(10);
    bench.set_column(200, 5, to_left);
    bench.set_pixel(start, 5.02f, {1, 0, 0});
    const BenchEnd end = trace(to_column());
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_EQ(end.pixel.x, 200);
    EXPECT_EQ(trace(to_column(), {{"hzb.near_plane_for_partial_texels", false}}).outcome, outcome_off_screen);
}

TEST_F(Hzb, RejectsItsOwnSurface) {
    const std::vector<BenchRay> rays = show_floor();
    EXPECT_EQ(hits("hzb", rays, {{"hzb.front_faces_only", false}}), 0u);
    EXPECT_GT(hits("hzb", rays, {{"hzb.front_faces_only", false}, {"hzb.reject_own_surface", false}}),
              rays.size() / 20);
}

/// A ray along the view's horizon into nothing: at the far plane it is as deep as what was not drawn.
TEST_F(Hzb, RejectsBackground) {
    bench.depth = HostImage(bench.view.extent, 1, bench.camera.depth.z);
    bench.set_pixel(start, 5, {1, 0, 0});
    const BenchRay into_depth{start, {0.02f, 0.01f, -1}};
    EXPECT_EQ(trace(into_depth).outcome, outcome_background);
    EXPECT_TRUE(trace(into_depth, {{"hzb.reject_background", false}, {"hzb.front_faces_only", false}}).is_hit());
}

TEST_F(Hzb, RejectsBackFaces) {
    turn_column();
    EXPECT_EQ(trace(to_column()).outcome, outcome_from_behind);
    EXPECT_TRUE(trace(to_column(), {{"hzb.front_faces_only", false}}).is_hit());
}

/// It stops at the first surface that it falls behind, whatever lies farther on.
TEST_F(Hzb, JudgesByThickness) {
    EXPECT_EQ(trace(behind_column()).outcome, outcome_too_thick);
    EXPECT_EQ(trace(behind_column(), {{"hzb.relative_thickness", 1.0}}).pixel, glm::ivec2(column, 40));
    bench.show_wall(10);
    bench.set_pixel(start, 5.02f, {1, 0, 0});
    const BenchEnd end = trace(behind_column());  // which is gone
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_NEAR(end.position.x, column + 40, 0.1);  // it comes 1 mm behind the wall there
}

TEST_F(Hzb, EndsOrGoesOnAtTheCoarsestLevel) {
    for (const unsigned mips : {2u, 3u}) {
        EXPECT_EQ(trace(to_column(), {{"hzb.pyramid_mips", mips}, {"hzb.at_coarsest", "miss"}}).outcome,
                  outcome_unfinished);
        EXPECT_EQ(trace(to_column(), {{"hzb.pyramid_mips", mips}}).pixel, glm::ivec2(column, 40));
    }
    // 120 pixels in steps of two, and in steps of up to 64.
    EXPECT_GT(trace(to_column(), {{"hzb.pyramid_mips", 2}}).fetches, 50u);
    EXPECT_LT(trace(to_column()).fetches, 30u);
}

/// Cells of four pixels, whose nearest surface counts.
TEST_F(Hzb, BeginsAndEndsOnItsBaseLevel) {
    const BenchEnd end = trace(to_column(), {{"hzb.base_level", 2}, {"hzb.relative_thickness", 10.0}});
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_NEAR(end.position.x, column / 4 * 4, 0.03);  // the overshoot is 0.02 pixels there
    EXPECT_LT(end.fetches, trace(to_column()).fetches);
}

TEST_F(Hzb, EndsWithItsIterations) {
    EXPECT_EQ(trace(to_column(), {{"hzb.max_iterations", 5}}).outcome, outcome_unfinished);
}

}  // namespace
