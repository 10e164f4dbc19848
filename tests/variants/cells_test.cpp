#include "tests/variants/pixel_march.h"
#include "tests/variants/tracer_walls_fixture.h"

#include <random>

// The parameters of the tracer cells, one by one.

namespace {

struct Cells : TracerAtWall {
    BenchEnd trace(const BenchRay& ray, const nlohmann::json& parameters = nlohmann::json::object()) {
        return bench.trace("cells", ray, parameters);
    }

    /// Hills with boxes and posts of a pixel before them.
    void show_clutter() {
        bench.view.extent = {193, 131};  // odd on three levels
        bench.show_wall(10);
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
        for (unsigned y = 0; y < bench.view.extent.y; ++y)
            for (unsigned x = 0; x < bench.view.extent.x; ++x) {
                float distance =
                    6.0f + 1.5f * std::sin(0.13f * float(x)) * std::cos(0.21f * float(y)) - 0.02f * float(y);
                if ((x / 12 + y / 16) % 5 == 0) distance = 2.0f + 0.01f * float(x);
                if (x % 37 == 3) distance = 1.5f;
                bench.set_pixel({x, y}, distance, glm::normalize(glm::vec3(uniform(random), uniform(random), 1.2f)));
            }
    }

    /// A wall, and pixels 7 m before it, here and there, that face to the right; rays begin there only.
    void show_posts() {
        bench.view.extent = {193, 131};
        bench.show_wall(10);
        for (unsigned y = 3; y < bench.view.extent.y; y += 11)
            for (unsigned x = 3; x < bench.view.extent.x; x += 13) bench.set_pixel({x, y}, 3, {1, 0, 0});
        farthest_start = 4;
    }
    float farthest_start = 1e3f;  ///< from the camera plane (m)

    struct Wrong {
        double end = 0;    ///< share of rays: hit or miss
        double pixel = 0;  ///< elsewhere
    };
    /// Against a look at every pixel, of rays whose ends do not hang on rounding.
    Wrong wrong(const nlohmann::json& parameters = nlohmann::json::object()) {
        std::vector<BenchRay> rays;
        std::vector<PixelMarchResult> truth;
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
        while (rays.size() < 3000) {
            const glm::uvec2 pixel(random() % bench.view.extent.x, random() % bench.view.extent.y);
            const glm::vec3 d(uniform(random), uniform(random), uniform(random));
            const glm::vec3 normal = bench.normal.rgb(size_t(pixel.y) * bench.view.extent.x + pixel.x);
            if (dot(d, d) > 1 || dot(d, d) < 1e-2f || dot(d, normal) <= 0) continue;
            if (-bench.position(pixel).z > farthest_start) continue;
            const PixelMarchResult result = march_every_pixel(
                bench.depth, bench.camera, {glm::ivec2(pixel), bench.position(pixel), normalize(d), normal}, 0.05);
            if (result.is_close_call) continue;
            rays.push_back({pixel, d});
            truth.push_back(result);
        }
        nlohmann::json all = {
            {"cells.thickness", 0.0}, {"cells.relative_thickness", 0.05}, {"cells.back_faces", "keep"}};
        all.update(parameters);
        const std::vector<BenchEnd> ends = bench.trace("cells", rays, all);
        Wrong wrong;
        for (size_t i = 0; i < rays.size(); ++i) {
            if (ends[i].is_hit() != truth[i].is_hit)
                wrong.end += 1.0 / double(rays.size());
            else if (truth[i].is_hit && ends[i].pixel != truth[i].pixel)
                wrong.pixel += 1.0 / double(rays.size());
        }
        return wrong;
    }
};

TEST_F(Cells, MeetTheColumn) {
    const BenchEnd end = trace(to_column());
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_EQ(end.pixel, glm::ivec2(column, start.y));
    EXPECT_NEAR(end.position.x, column, 1e-3);
    EXPECT_NEAR(end.distance, to_column_meters(float(column) - start.x - 0.5f), 2e-4);
    EXPECT_EQ(end.confidence, 1);
}

/// All depths of a cell find what a look at every pixel finds.
TEST_F(Cells, CompareAllDepthsOfTheRayInACell) {
    show_clutter();
    const Wrong found = wrong();
    EXPECT_EQ(found.end, 0);
    EXPECT_EQ(found.pixel, 0);
}

/// The depth at a cell's entry alone does not: a ray comes out of a coarse cell farther behind the wall than counts as
/// solid, or is seen to be behind it in the next pixel. Whether safe steps are counted anew changes little.
TEST_F(Cells, MissWhatLiesBehindTheEntryOfACellAsPrinted) {
    show_posts();
    EXPECT_EQ(wrong().end, 0);
    EXPECT_EQ(wrong().pixel, 0);
    for (const bool resets : {true, false}) {
        const Wrong printed = wrong({{"cells.interval", false}, {"cells.reset_safe_steps", resets}});
        EXPECT_GT(printed.end, 0.05);    // of 0.11
        EXPECT_GT(printed.pixel, 0.05);  // of 0.08 and 0.07
    }
}

/// The levels are a way to the same end.
TEST_F(Cells, GoCoarserAfterSafeSteps) {
    show_clutter();
    for (const nlohmann::json& levels : {nlohmann::json{{"cells.safe_steps", 1}},
                                         {{"cells.reset_safe_steps", false}},
                                         {{"cells.pyramid_mips", 2}},
                                         {{"cells.pyramid_mips", 13}}}) {
        const Wrong found = wrong(levels);
        EXPECT_EQ(found.end, 0) << levels;
        EXPECT_EQ(found.pixel, 0) << levels;
    }
    bench.view.extent = {200, 80};
    bench.show_wall(10);
    bench.set_pixel(start, 5.02f, {1, 0, 0});
    // 179 pixels to the border in cells of 1, 2, 4 ... 64, three of each or one of each.
    const BenchRay across{start, {1, 0, 0}};
    const auto fetches = [&](const nlohmann::json& levels) { return trace(across, levels).fetches; };
    EXPECT_GT(fetches({{"cells.safe_steps", 64}}), 100u);
    EXPECT_LT(fetches(nlohmann::json::object()), 25u);
    EXPECT_LT(fetches({{"cells.safe_steps", 1}}), fetches(nlohmann::json::object()));
    EXPECT_LT(fetches({{"cells.reset_safe_steps", false}}), fetches(nlohmann::json::object()));
    EXPECT_GT(fetches({{"cells.pyramid_mips", 2}}), 80u);
}

TEST_F(Cells, EndWithTheirSteps) {
    const BenchEnd end = trace(to_column(), {{"cells.max_steps", 3}});
    EXPECT_EQ(end.outcome, outcome_unfinished);
    EXPECT_NEAR(end.position.x, 24, 0.01);  // three pixels after its own
}

TEST_F(Cells, ReachAsFarAsTheirDistance) {
    const float far = to_column_meters();
    EXPECT_TRUE(trace(to_column(), {{"cells.max_distance", 1.01f * far}}).is_hit());
    const BenchEnd end = trace(to_column(), {{"cells.max_distance", 0.9f * far}});
    EXPECT_EQ(end.outcome, outcome_unfinished);
    EXPECT_NEAR(end.distance, 0.9f * far, 1e-3);
}

/// Behind the column by 30 cm.
TEST_F(Cells, PassBehindWhatIsThin) {
    const BenchRay ray = bench.ray_to(start, {column + 40, 40.5f}, 5.4f);
    EXPECT_FALSE(trace(ray).is_hit());
    EXPECT_EQ(trace(ray, {{"cells.thickness", 1.0}}).pixel.x, int(column));
    EXPECT_EQ(trace(ray, {{"cells.relative_thickness", 0.2}}).pixel.x, int(column));
    bench.set_column(column + 20, 5.3f, to_left);
    EXPECT_EQ(trace(ray).pixel.x, int(column) + 20);
}

/// Behind a screen of 32 pixels, by 30 cm and less, to a column beyond it.
TEST_F(Cells, PassBehindWideThingsInCoarserCells) {
    const BenchRay ray = bench.ray_to(start, {column + 40, 40.5f}, 5.4f);
    for (unsigned x = column; x < column + 32; ++x) bench.set_column(x, 4.8f, to_left);
    bench.set_column(column + 39, 5.37f, to_left);
    const BenchEnd by_pixel = trace(ray), by_cell = trace(ray, {{"cells.behind_level", 3}});
    EXPECT_EQ(by_pixel.pixel.x, int(column) + 39);
    EXPECT_EQ(by_cell.pixel.x, by_pixel.pixel.x);
    EXPECT_LT(by_cell.fetches + 15, by_pixel.fetches) << "half of the screen's 32 pixels";
    // Hits beside outlines are lost: 1.6 % and 3.1 % of 3000 rays, which are the same in each run. The bounds leave
    // room for 13 and 27 rays, since devices round differently.
    show_clutter();
    EXPECT_LT(wrong({{"cells.behind_level", 1}}).end, 0.02);
    EXPECT_LT(wrong({{"cells.behind_level", 2}}).end, 0.04);
}

/// As of fixed_stride: the line turns round, into the wall.
TEST_F(Cells, ClipAtTheNearPlane) {
    bench.show_wall(0.3f);
    const BenchRay ray = bench.ray_to({60, 40}, {100, 40.5f}, 0.1f);
    EXPECT_EQ(trace(ray, {{"cells.thickness", 100.0}}).outcome, outcome_behind_camera);
    const BenchEnd turned =
        trace(ray, {{"cells.clip_to_near_plane", false}, {"cells.thickness", 100.0}, {"cells.back_faces", "keep"}});
    EXPECT_TRUE(turned.is_hit()) << turned;
    EXPECT_LT(turned.position.x, 60.5f);
}

TEST_F(Cells, LeaveTheirOwnPlane) {
    const std::vector<BenchRay> rays = show_floor();
    EXPECT_EQ(hits("cells", rays, {{"cells.back_faces", "keep"}}), 0u);
    EXPECT_GT(hits("cells", rays, {{"cells.back_faces", "keep"}, {"cells.leave_own_plane", false}}), rays.size() / 20);
}

/// 1e-4 of the range of device depth begin at 91 m, of 100 m.
TEST_F(Cells, TakeTheFarAwayForSky) {
    for (const auto& [distance, is_sky] : {std::pair(90.0f, false), {92.0f, true}}) {
        bench.show_wall(98);
        bench.set_pixel(start, 1.02f * distance, {1, 0, 0});
        for (unsigned x = column; x < 200; ++x) bench.set_column(x, distance, to_left);
        EXPECT_TRUE(trace(to_column(), {{"cells.thickness", 3.0}}).is_hit());
        EXPECT_EQ(trace(to_column(), {{"cells.thickness", 3.0}, {"cells.sky_depth", 1e-4}}).is_hit(), !is_sky);
    }
}

TEST_F(Cells, KeepFadeOrRejectBackFaces) {
    bench.set_column(column, 5, glm::normalize(glm::vec3(0.6f, 0, 0.8f)));  // the cosine to the ray is 0.6
    EXPECT_EQ(trace(to_column()).outcome, outcome_from_behind);
    EXPECT_EQ(trace(to_column(), {{"cells.back_faces", "keep"}}).confidence, 1);
    EXPECT_NEAR(trace(to_column(), {{"cells.back_faces", "fade"}}).confidence, 0.4f, 1e-4);
    turn_column();
    EXPECT_EQ(trace(to_column(), {{"cells.back_faces", "fade"}}).outcome, outcome_from_behind);
    make_wall();
    EXPECT_EQ(trace(to_column(), {{"cells.back_faces", "fade"}}).confidence, 1);
}

TEST_F(Cells, FadeTowardsTheEdge) {
    EXPECT_NEAR(trace(to_column(), {{"cells.edge_fade", true}}).confidence, 1, 1e-3);
    const auto end = [&](float from, float to) {
        return trace(to_column(), {{"cells.edge_fade", true}, {"cells.fade_start", from}, {"cells.fade_end", to}});
    };
    EXPECT_NEAR(end(0.2f, 0.6f).confidence, 0.5f, 1e-3);  // the column is at 0.4 of the way from the middle
    EXPECT_EQ(end(0.1f, 0.3f).outcome, outcome_off_screen);
}

TEST_F(Cells, FadeWithTheDistance) {
    const float far = trace(to_column()).distance;
    EXPECT_NEAR(trace(to_column(), {{"cells.distance_fade", true}, {"cells.max_distance", 2 * far}}).confidence, 0.5f,
                1e-3);
}

TEST_F(Cells, FadeAtGrazingAngles) {
    bench.set_pixel(start, 5.02f, glm::normalize(glm::vec3(0.3f, 0, 0.953939f)));  // sine 0.3 to the ray
    EXPECT_NEAR(trace(to_column(), {{"cells.grazing_fade", 0.6}}).confidence, 0.5f, 1e-3);
    EXPECT_EQ(trace(to_column(), {{"cells.grazing_fade", 0.29}}).confidence, 1);
}

}  // namespace
