#include "tests/variants/tracer_walls_fixture.h"

// The parameters of the tracer fixed_stride, one by one.

namespace {

struct FixedStride : TracerAtWall {
    BenchEnd trace(const BenchRay& ray, const nlohmann::json& parameters = nlohmann::json::object()) {
        return bench.trace("fixed_stride", ray, parameters);
    }
    /// It passes behind the column by 30 cm and meets the wall 40 pixels farther.
    BenchRay behind_column() const { return bench.ray_to(start, {column + 40, 40.5f}, 5.8f); }
};

TEST_F(FixedStride, MeetsTheColumn) {
    const BenchEnd end = trace(to_column());
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_EQ(end.pixel, glm::ivec2(column, start.y));
    EXPECT_NEAR(end.position.x, column, 1.0f / 256 + 1e-3f);  // a pixel, halved eight times
    EXPECT_NEAR(end.distance, to_column_meters(float(column) - start.x - 0.5f), 2e-4);
    EXPECT_EQ(end.confidence, 1);
}

/// Half a stride of eight late on average without refinement; thickness counts where the ray falls behind.
TEST_F(FixedStride, RefinesLongStrides) {
    const nlohmann::json plain = {
        {"fixed_stride.stride", 8.0}, {"fixed_stride.stride_z_cutoff", 0.0}, {"fixed_stride.refine", false}};
    bench.set_column(column + 1, 5, to_left);
    for (unsigned x = column + 2; x < column + 20; ++x) bench.set_column(x, 5, to_left);
    const BenchEnd coarse = trace(to_column(), plain);
    EXPECT_TRUE(coarse.is_hit()) << coarse;
    EXPECT_NEAR(coarse.position.x, 20.5f + 15 * 8, 1e-3);  // the first multiple of 8 from 119.5 on
    for (unsigned steps : {1u, 3u, 8u}) {
        nlohmann::json refined = plain;
        refined.update({{"fixed_stride.binary_search_steps", steps}, {"fixed_stride.refine", true}});
        const float position = trace(to_column(), refined).position.x, stride = 8 / std::exp2(float(steps));
        EXPECT_TRUE(position >= column - 1e-3f && position <= column + stride + 1e-3f) << steps << ": " << position;
        refined["fixed_stride.refine"] = false;
        EXPECT_EQ(trace(to_column(), refined).position.x, coarse.position.x) << steps;
    }
}

/// From a distance on strides are single pixels, and as many more are looked at.
TEST_F(FixedStride, ShortensStridesInTheDistance) {
    const auto fetches = [&](float cutoff) {
        return trace(to_column(), {{"fixed_stride.stride", 8.0},
                                   {"fixed_stride.refine", false},
                                   {"fixed_stride.max_distance", 3.0},
                                   {"fixed_stride.stride_z_cutoff", cutoff}})
            .fetches;
    };
    const float pixels = 3 / to_column_meters(1);  // of the ray's whole length, which ends before the column
    EXPECT_NEAR(fetches(0), pixels / 8, 2);        // and one fetch of the origin's depth
    EXPECT_NEAR(fetches(5), pixels, 2);
    EXPECT_NEAR(fetches(10.04f), pixels / 4.5f, 2);  // half way between 8 and 1
}

TEST_F(FixedStride, BeginsSoonerAtRandom) {
    const nlohmann::json parameters = {{"fixed_stride.stride", 8.0},
                                       {"fixed_stride.stride_z_cutoff", 0.0},
                                       {"fixed_stride.refine", false},
                                       {"fixed_stride.jitter", 0.5}};
    for (unsigned x = column; x < column + 20; ++x) bench.set_column(x, 5, to_left);
    BenchRay ray = to_column();
    ray.random = 0.25f;  // a pixel sooner: the step that met the column ends half a pixel before it
    EXPECT_NEAR(trace(ray, parameters).position.x, 20.5f + 16 * 8 - 1, 1e-3);
    ParameterSet params;
    Tracers tracers(params, {{"tracer", "trace", "fixed_stride", "a test's"}}, "the test");
    EXPECT_FALSE(tracers.needs().random);
    params.assign(parameters);
    EXPECT_TRUE(tracers.needs().random);
}

/// 64 steps of a pixel do not reach the column, 120 pixels away, nor do the document's 96 of half a pixel.
TEST_F(FixedStride, ReachesAsFarAsItsSteps) {
    for (const auto& [steps, stride, reach] : {std::tuple(64, 1.0f, 64.0f), {96, 0.5f, 48.0f}}) {
        const BenchEnd end = trace(to_column(), {{"fixed_stride.max_steps", steps},
                                                 {"fixed_stride.stride", stride},
                                                 {"fixed_stride.stride_z_cutoff", 0.0}});
        EXPECT_EQ(end.outcome, outcome_unfinished);
        EXPECT_NEAR(end.position.x, 20.5f + reach, 1e-2);
        EXPECT_NEAR(end.distance, to_column_meters(reach), 1e-3);
    }
    EXPECT_TRUE(trace(to_column(), {{"fixed_stride.max_steps", 120}}).is_hit());
}

/// The document's qualities Low to Ultra with its cutoff of 100 m: near the camera the best reaches least far, far away
/// the worst.
TEST_F(FixedStride, ReachOfTheQualitiesTurnsRoundWithTheDistance) {
    bench.show_wall(99);
    const auto reach = [&](float meters, int steps, float stride) {
        bench.set_pixel(start, meters, {1, 0, 0});
        const BenchEnd end = trace(to_column(), {{"fixed_stride.max_steps", steps}, {"fixed_stride.stride", stride}});
        EXPECT_EQ(end.outcome, outcome_unfinished);
        return end.position.x - 20.5f;
    };
    struct Row {
        float meters;
        std::array<float, 4> pixels;
    };
    for (const Row& row :
         {Row{1, {63.7f, 71.8f, 64, 48.5f}}, {20, {57.6f, 67.2f, 64, 57.6f}}, {67, {42.6f, 55.9f, 64, 80.2f}}}) {
        const std::array<float, 4> found = {reach(row.meters, 32, 2), reach(row.meters, 48, 1.5f),
                                            reach(row.meters, 64, 1), reach(row.meters, 96, 0.5f)};
        for (size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], row.pixels[i], 0.1f) << row.meters << " m, " << i;
    }
}

TEST_F(FixedStride, ReachesAsFarAsItsDistance) {
    const float far = to_column_meters();
    EXPECT_TRUE(trace(to_column(), {{"fixed_stride.max_distance", 1.01f * far}}).is_hit());
    const BenchEnd end = trace(to_column(), {{"fixed_stride.max_distance", 0.9f * far}});
    EXPECT_EQ(end.outcome, outcome_unfinished);
    EXPECT_NEAR(end.distance, 0.9f * far, 1e-3);
}

TEST_F(FixedStride, PassesBehindWhatIsThin) {
    const BenchRay ray = behind_column();
    EXPECT_FALSE(trace(ray).is_hit());  // 80 cm above the wall at the end of the screen
    for (const nlohmann::json& thick :
         {nlohmann::json{{"fixed_stride.thickness", 1.0}}, nlohmann::json{{"fixed_stride.relative_thickness", 0.2}}}) {
        const BenchEnd end = trace(ray, thick);
        EXPECT_TRUE(end.is_hit()) << end;
        EXPECT_EQ(end.pixel.x, int(column));
    }
    bench.set_column(column + 20, 5.65f, to_left);  // behind which it is by a few centimetres
    EXPECT_EQ(trace(ray).pixel.x, int(column) + 20);
}

/// 200 x 80 pixels: a direction of 45 degrees on the screen is one of 22 in uv.
TEST_F(FixedStride, StepsInPixelsOrInUv) {
    const BenchRay diagonal = bench.ray_to(start, {50.9f, 10.5f}, 5.02f);
    for (unsigned x = 0; x < 200; ++x) bench.set_pixel({x, 10}, 5.01f, glm::normalize(glm::vec3(-1, -1, 1)));
    const BenchEnd end = trace(diagonal),
                   uv = trace(diagonal, {{"fixed_stride.step", "uv"}, {"fixed_stride.leave_own_surface", false}});
    EXPECT_EQ(end.pixel, glm::ivec2(50, 10)) << end;
    EXPECT_EQ(uv.pixel.y, 10) << uv;
    EXPECT_NEAR(uv.position.x, 20.5f + (40.5f - uv.position.y) * 30.4f / 30 * 80 / 200, 0.01);
}

/// From a wall close to the camera to the right, past it. Behind the camera the far end is projected to the other side:
/// the line runs to the left, into the wall.
TEST_F(FixedStride, ClipsAtTheNearPlane) {
    bench.show_wall(0.3f);
    const BenchRay ray = bench.ray_to({60, 40}, {100, 40.5f}, 0.1f);
    const nlohmann::json unclipped = {{"fixed_stride.clip_to_near_plane", false},
                                      {"fixed_stride.thickness", 100.0},
                                      {"fixed_stride.front_faces_only", false}};
    EXPECT_EQ(trace(ray, {{"fixed_stride.thickness", 100.0}}).outcome, outcome_behind_camera);
    const BenchEnd turned = trace(ray, unclipped);
    EXPECT_TRUE(turned.is_hit()) << turned;
    EXPECT_LT(turned.position.x, 60.5f);
    nlohmann::json shorter = unclipped;
    shorter["fixed_stride.max_distance"] = 0.2;  // which ends before the camera
    EXPECT_EQ(trace(ray, shorter).outcome, outcome_unfinished);
}

TEST_F(FixedStride, MayRejectRaysTowardsTheCamera) {
    const BenchRay ray = bench.ray_to({21, 40}, {column + 0.5f, 40.5f}, 5.01f);
    EXPECT_EQ(trace(ray).pixel.x, int(column));
    EXPECT_EQ(trace(ray, {{"fixed_stride.reject_towards_camera", true}}).outcome, outcome_behind_camera);
    EXPECT_TRUE(trace(to_column(), {{"fixed_stride.reject_towards_camera", true}}).is_hit());
}

TEST_F(FixedStride, LeavesItsOwnSurface) {
    const std::vector<BenchRay> rays = show_floor();
    const nlohmann::json both = {{"fixed_stride.front_faces_only", false}, {"fixed_stride.stride", 0.25}};
    EXPECT_EQ(hits("fixed_stride", rays, both), 0u);
    nlohmann::json printed = both;
    printed["fixed_stride.leave_own_surface"] = false;
    EXPECT_GT(hits("fixed_stride", rays, printed), rays.size() / 20);
}

TEST_F(FixedStride, RejectsBackFaces) {
    turn_column();
    EXPECT_EQ(trace(to_column()).outcome, outcome_from_behind);
    EXPECT_TRUE(trace(to_column(), {{"fixed_stride.front_faces_only", false}}).is_hit());
}

/// 1e-4 of the range of device depth begin at 91 m, of 100 m.
TEST_F(FixedStride, TakesTheFarAwayForSky) {
    for (const auto& [distance, is_sky] : {std::pair(90.0f, false), {92.0f, true}}) {
        bench.show_wall(98);
        bench.set_pixel(start, 1.02f * distance, {1, 0, 0});
        for (unsigned x = column; x < 200; ++x) bench.set_column(x, distance, to_left);
        EXPECT_TRUE(trace(to_column(), {{"fixed_stride.thickness", 3.0}}).is_hit());
        EXPECT_EQ(trace(to_column(), {{"fixed_stride.thickness", 3.0}, {"fixed_stride.sky_depth", 1e-4}}).is_hit(),
                  !is_sky);
    }
}

/// The column at 140 of 200 pixels is at 0.4 of the way from the middle to the border.
TEST_F(FixedStride, FadesTowardsTheEdge) {
    EXPECT_NEAR(trace(to_column(), {{"fixed_stride.edge_fade", true}}).confidence, 1, 1e-3);
    const auto confidence = [&](float start, float end) {
        return trace(to_column(), {{"fixed_stride.edge_fade", true},
                                   {"fixed_stride.fade_start", start},
                                   {"fixed_stride.fade_end", end}})
            .confidence;
    };
    EXPECT_NEAR(confidence(0.2f, 0.6f), 0.5f, 1e-3);
    EXPECT_NEAR(confidence(0.3f, 0.5f), 0.5f, 1e-3);
    EXPECT_NEAR(confidence(0.0f, 0.5f), 0.2f, 1e-3);
    EXPECT_EQ(confidence(0.1f, 0.3f), 0);
}

TEST_F(FixedStride, FadesWithTheDistance) {
    const float far = trace(to_column()).distance;
    EXPECT_NEAR(
        trace(to_column(), {{"fixed_stride.distance_fade", true}, {"fixed_stride.max_distance", 2 * far}}).confidence,
        0.5f, 1e-3);
    EXPECT_NEAR(trace(to_column(), {{"fixed_stride.distance_fade", true}}).confidence, 1 - far / 200, 1e-3);
}

}  // namespace
