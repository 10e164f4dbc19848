#include "tests/variants/tracer_walls_fixture.h"

// The parameters of the tracer view_space, one by one.

namespace {

struct ViewSpace : TracerAtWall {
    BenchEnd trace(const BenchRay& ray, const nlohmann::json& parameters = nlohmann::json::object()) {
        return bench.trace("view_space", ray, parameters);
    }
    void SetUp() override {
        make_wall();
        for (unsigned x = column; x < 200; ++x) bench.set_column(x, 5, to_left);  // that no step passes over
    }
    float column_meters() const { return to_column_meters(float(column) - start.x - 0.5f); }
};

/// To the pixel's wall, within a step, halved.
TEST_F(ViewSpace, RefinesToTheColumn) {
    for (const unsigned refinements : {0u, 1u, 5u, 12u}) {
        const BenchEnd end = trace(to_column(), {{"view_space.refinements", refinements}});
        const float step = 40.0f / 512 / std::exp2(float(refinements));
        EXPECT_TRUE(end.is_hit()) << end;
        EXPECT_EQ(end.confidence, 1);
        EXPECT_GE(end.distance, column_meters() - 1e-4f);
        EXPECT_LE(end.distance, column_meters() + step + 1e-4f);
        EXPECT_NEAR((end.position.x - 20.5f) / 119.5f, end.distance / column_meters(), 1e-4);
        EXPECT_EQ(end.pixel, glm::ivec2(floor(end.position)));
    }
}

TEST_F(ViewSpace, ReachesAsFarAsItsDistance) {
    const float far = column_meters();
    EXPECT_TRUE(trace(to_column(), {{"view_space.max_distance", 1.01f * far}}).is_hit());
    const BenchEnd end = trace(to_column(), {{"view_space.max_distance", 0.9f * far}});
    EXPECT_EQ(end.outcome, outcome_unfinished);
    EXPECT_NEAR(end.distance, 0.9f * far, 1e-3);
    const float depths = far / 5.02f;
    EXPECT_TRUE(
        trace(to_column(), {{"view_space.max_distance", 0.0}, {"view_space.relative_max_distance", 1.01f * depths}})
            .is_hit());
    EXPECT_FALSE(
        trace(to_column(), {{"view_space.max_distance", 0.0}, {"view_space.relative_max_distance", 0.9f * depths}})
            .is_hit());
}

/// Its step must not pass over what is met, in width or in depth.
TEST_F(ViewSpace, TakesItsSteps) {
    make_wall();  // the column is a pixel wide: 7 cm
    const float meters = to_column_meters(1);
    EXPECT_TRUE(trace(to_column(), {{"view_space.steps", unsigned(40 / meters * 1.1f)}}).is_hit());
    // One step ends half a step before the column, the next as far behind it.
    const float step = column_meters() / 3.5f;
    EXPECT_FALSE(trace(to_column(), {{"view_space.steps", 6}, {"view_space.max_distance", 6 * step}}).is_hit());
}

TEST_F(ViewSpace, PassesBehindWhatIsThin) {
    const BenchRay ray = bench.ray_to(start, {column + 40, 40.5f}, 5.4f);  // 30 cm behind
    EXPECT_FALSE(trace(ray).is_hit());
    EXPECT_TRUE(trace(ray, {{"view_space.thickness", 1.0}}).is_hit());
    EXPECT_TRUE(trace(ray, {{"view_space.relative_thickness", 0.2}}).is_hit());
}

/// The step that meets the column ends 7 pixels behind its wall, and begins 35 before it. The first two halves of it
/// end before the wall, the third behind it, the fourth before it.
TEST_F(ViewSpace, ReturnsTheBestOrTheLastPlace) {
    const float pixels = 42, end = 147.5f, step = to_column_meters(pixels);
    const auto halved = [&](unsigned refinements, nlohmann::json others) {
        others.update({{"view_space.max_distance", 4 * step}, {"view_space.steps", 4}});
        others["view_space.refinements"] = refinements;
        BenchRay ray = to_column();
        return trace(ray, others);
    };
    const nlohmann::json best = nlohmann::json::object(), last = {{"view_space.return_best", false}},
                         untested = {{"view_space.return_best", false}, {"view_space.test_returned", false}};
    const float third = end - pixels / 8, fourth = end - pixels / 4 + pixels / 16;
    ASSERT_LT(fourth, float(column));
    for (const auto& [refinements, position] : {std::pair(2u, end), {3u, third}, {4u, third}})
        EXPECT_NEAR(halved(refinements, best).position.x, position - 1, 0.02) << refinements;
    EXPECT_EQ(halved(2, last).outcome, outcome_too_thick);
    EXPECT_EQ(halved(2, untested).outcome, outcome_too_thick);  // no half has met anything
    EXPECT_TRUE(halved(3, last).is_hit());
    EXPECT_EQ(halved(4, last).outcome, outcome_too_thick);
    nlohmann::json of_any_side = untested;
    of_any_side["view_space.front_faces_only"] = false;
    const BenchEnd printed = halved(4, of_any_side);
    EXPECT_TRUE(printed.is_hit()) << printed;
    EXPECT_NEAR(printed.position.x, fourth - 1, 0.02);  // where the wall is seen
}

/// Behind the camera a ray's points are in front of all that is seen, and its steps lead nowhere.
TEST_F(ViewSpace, ClipsAtTheNearPlane) {
    bench.show_wall(10);
    const BenchRay ray = bench.ray_to({90, 40}, {110, 40.5f}, 0.1f);
    const BenchEnd end = trace(ray), unclipped = trace(ray, {{"view_space.clip_to_near_plane", false}});
    EXPECT_EQ(end.outcome, outcome_behind_camera) << end;
    EXPECT_NEAR(end.distance, distance(bench.position({90, 40}), glm::vec3(0, 0, -0.1f)), 0.05);
    EXPECT_EQ(unclipped.outcome, outcome_unfinished) << unclipped;
    EXPECT_NEAR(unclipped.distance, 40, 1e-3);
}

TEST_F(ViewSpace, LeavesItsOwnSurface) {
    const std::vector<BenchRay> rays = show_floor();
    EXPECT_EQ(hits("view_space", rays, {{"view_space.front_faces_only", false}}), 0u);
    EXPECT_GT(
        hits("view_space", rays, {{"view_space.front_faces_only", false}, {"view_space.leave_own_surface", false}}),
        rays.size() / 20);
}

TEST_F(ViewSpace, RejectsBackFaces) {
    for (unsigned x = column; x < 200; ++x) bench.set_column(x, 5, {1, 0, 0});
    EXPECT_EQ(trace(to_column()).outcome, outcome_from_behind);
    EXPECT_TRUE(trace(to_column(), {{"view_space.front_faces_only", false}}).is_hit());
}

/// Lettier's three factors, here of the way across the view, of 2 cm of 10, and of the ray's length.
TEST_F(ViewSpace, FadesByVisibility) {
    const BenchEnd end = trace(to_column(), {{"view_space.visibility_fade", true}});
    const float towards_camera = std::max(glm::normalize(-bench.position(start)).x, 0.0f);
    const float expected = (1 - towards_camera) * (1 - 0.02f / 0.1f) * (1 - end.distance / 40);
    EXPECT_NEAR(end.confidence, expected, 2e-3);                  // of depth, which float keeps to 1e-4 of 2 cm
    EXPECT_TRUE(towards_camera > 0.1f && towards_camera < 0.9f);  // not an empty test
}

}  // namespace
