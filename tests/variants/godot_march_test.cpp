#include "tests/variants/tracer_walls_fixture.h"

#include <random>

// The parameters of the tracer godot, one by one.

namespace {

struct GodotMarch : TracerAtWall {
    BenchEnd trace(const BenchRay& ray, const nlohmann::json& parameters = nlohmann::json::object()) {
        return bench.trace("godot", ray, parameters);
    }
    float column_meters() const { return to_column_meters(float(column) - start.x - 0.5f); }
};

TEST_F(GodotMarch, MeetsTheColumn) {
    const BenchEnd end = trace(to_column());
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_EQ(end.pixel, glm::ivec2(column, start.y));
    EXPECT_NEAR(end.position.x, column, 1e-3);
    EXPECT_NEAR(end.distance, column_meters(), 2e-4);
    EXPECT_EQ(end.confidence, 1);
}

/// Its way through the pyramid is another one to the end that `cells` finds, in boxes and posts on an odd size.
TEST_F(GodotMarch, EndsWhereCellsDoes) {
    bench.view.extent = {193, 131};
    bench.show_wall(10);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (unsigned y = 0; y < bench.view.extent.y; ++y)
        for (unsigned x = 0; x < bench.view.extent.x; ++x) {
            float distance = 6.0f + 1.5f * std::sin(0.13f * float(x)) * std::cos(0.21f * float(y)) - 0.02f * float(y);
            if ((x / 12 + y / 16) % 5 == 0) distance = 2.0f + 0.01f * float(x);
            if (x % 37 == 3) distance = 1.5f;
            bench.set_pixel({x, y}, distance, glm::normalize(glm::vec3(uniform(random), uniform(random), 1.2f)));
        }
    std::vector<BenchRay> rays;
    while (rays.size() < 3000) {
        const glm::uvec2 pixel(random() % bench.view.extent.x, random() % bench.view.extent.y);
        const glm::vec3 d(uniform(random), uniform(random), uniform(random));
        const glm::vec3 normal = bench.normal.rgb(size_t(pixel.y) * bench.view.extent.x + pixel.x);
        if (dot(d, d) > 1e-2f && dot(d, normal) > 0) rays.push_back({pixel, d});
    }
    const std::vector<BenchEnd> ends = bench.trace("godot", rays, {{"godot.relative_thickness", 0.05}}),
                                cells = bench.trace("cells", rays,
                                                    {{"cells.thickness", 0.0}, {"cells.relative_thickness", 0.05}});
    unsigned hits = 0, others = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        hits += cells[i].is_hit();
        others += ends[i].outcome != cells[i].outcome || (cells[i].is_hit() && ends[i].pixel != cells[i].pixel);
    }
    EXPECT_GT(hits, 300u);
    EXPECT_EQ(others, 0u);
}

/// Coarse cells have no thickness: a ray that passes 3 m behind 64 pixels looks at each of them, and at few of those
/// that it passes before.
TEST_F(GodotMarch, TellsWhatIsThinByPixelsAlone) {
    bench.show_wall(10);
    bench.set_pixel(start, 5.02f, {1, 0, 0});
    const unsigned free = trace(to_column()).fetches;
    EXPECT_LT(free, 25u);
    for (unsigned x = 64; x < 128; ++x) bench.set_column(x, 2, to_left);
    const BenchEnd end = trace(to_column());
    EXPECT_EQ(end.outcome, outcome_off_screen) << end;
    EXPECT_GE(end.fetches, 64u);
    EXPECT_LT(end.fetches, 64u + free + 14u);  // and down to the pixels and up again
    bench.set_column(140, 5, to_left);
    EXPECT_EQ(trace(to_column()).pixel.x, 140);  // it has not lost what lies beyond
    EXPECT_EQ(trace(to_column(), {{"godot.thickness", 4.0}}).pixel.x, 64);
    EXPECT_EQ(trace(to_column(), {{"godot.relative_thickness", 2.0}}).pixel.x, 64);
}

/// A ray that comes nearer enters the column's pixel 30 cm behind it and leaves it 10 cm before it.
TEST_F(GodotMarch, ComparesAllDepthsInAPixel) {
    const glm::uvec2 from{135, 40};
    const float rate = 1 / 4.9f - 1 / 5.3f;  // of the inverse depth, per pixel
    bench.set_column(column, 5, {1, 0, 0});  // which rays to the camera come to from the right
    bench.set_pixel(from, 1 / (1 / 5.3f - 4.5f * rate), {0, 0, 1});
    const BenchRay ray = bench.ray_to(from, {column, 40.5f}, 5.3f);
    const BenchEnd met = trace(ray, {{"godot.thickness", 0.1}}),
                   printed = trace(ray, {{"godot.thickness", 0.1}, {"godot.interval", false}});
    EXPECT_EQ(met.pixel.x, int(column)) << met;
    EXPECT_NEAR(met.position.x, float(column) + (1 / 5.0f - 1 / 5.3f) / rate, 0.01f);
    EXPECT_FALSE(printed.is_hit()) << printed;
    // Thick enough for where it enters, which is where it ends.
    const BenchEnd thick = trace(ray, {{"godot.thickness", 0.4}, {"godot.interval", false}});
    EXPECT_NEAR(thick.position.x, column, 0.01f) << thick;
}

TEST_F(GodotMarch, EndsWithItsSteps) {
    const BenchEnd end = trace(to_column(), {{"godot.max_steps", 3}});
    EXPECT_EQ(end.outcome, outcome_unfinished);
    const nlohmann::json printed = {
        {"godot.max_steps", 3}, {"godot.reject_unfinished", false}, {"godot.back_faces", "near"}};
    const BenchEnd judged = trace(to_column(), printed);
    EXPECT_TRUE(judged.is_hit()) << judged;  // of a wall 5 m behind it
    EXPECT_NEAR(judged.position.x, end.position.x, 1e-3);
    nlohmann::json faded = printed;
    faded.update({{"godot.fade_off_surface", true}, {"godot.thickness", 1.0}});
    EXPECT_EQ(trace(to_column(), faded).outcome, outcome_too_thick);
}

TEST_F(GodotMarch, LeavesItsOwnPlane) {
    const std::vector<BenchRay> rays = show_floor();
    EXPECT_EQ(hits("godot", rays), 0u);
    // Of rays that leave a plane none meets its front.
    for (size_t i = 0; i < bench.normal.pixel_count(); ++i) bench.normal.set_rgb(i, {0, 0, 1});
    EXPECT_GT(hits("godot", rays, {{"godot.leave_own_plane", false}}), rays.size() / 20);
}

/// Normals at 60 degrees: the ray begins 1 - 1/256 of the bias before its surface.
TEST_F(GodotMarch, BeginsAboveItsSurface) {
    bench.shading_normal = bench.normal;
    bench.shading_normal.set_rgb(start.y * 200u + start.x, {0.5f, 0, std::sqrt(0.75f)});
    const BenchEnd end = trace(to_column(), {{"godot.normal_bias", 1.0}});
    EXPECT_TRUE(end.is_hit()) << end;
    EXPECT_NEAR(end.distance, column_meters() - (1 - 1 / 256.0f), 1e-3);
    EXPECT_NEAR(end.position.x, column, 1e-3);
    bench.shading_normal = bench.normal;
    EXPECT_NEAR(trace(to_column(), {{"godot.normal_bias", 1.0}}).distance, column_meters(), 1e-3);
}

TEST_F(GodotMarch, BouncesOffItsSurface) {
    const BenchRay ray{start, {-1, 0, 0}};
    EXPECT_FALSE(trace(ray).is_hit());
    EXPECT_EQ(trace(ray, {{"godot.bounce", true}}).pixel.x, int(column));
}

TEST_F(GodotMarch, RejectsBackFaces) {
    const auto turned = [&](unsigned x, const char* back_faces) {
        make_wall();
        bench.set_column(column, 10, to_left);
        bench.set_column(x, 5, {1, 0, 0});
        bench.set_pixel(start, 5.02f, {1, 0, 0});
        return trace(to_column(), {{"godot.back_faces", back_faces}});
    };
    EXPECT_EQ(turned(column, "reject").outcome, outcome_from_behind);
    EXPECT_TRUE(turned(column, "near").is_hit());
    EXPECT_EQ(turned(start.x + 2, "near").outcome, outcome_from_behind);  // 1.5 pixels on
    EXPECT_TRUE(turned(start.x + 3, "near").is_hit());
}

TEST_F(GodotMarch, Fades) {
    const float share = 119.5f / 200;
    EXPECT_NEAR(trace(to_column(), {{"godot.fade_in", 0.15}}).confidence, std::pow(share, 0.15f), 1e-4);
    EXPECT_NEAR(trace(to_column(), {{"godot.fade_out", 2.0}}).confidence, (1 - share) * (1 - share), 1e-4);
    const auto smooth = [](float x) { return x * x * (3 - 2 * x); };
    // 2 cm of depth behind the column, of 8; it is the distance in the pixel's direction that counts.
    const float away = 0.02f * length(bench.position(start) + glm::vec3(column_meters(), 0, 0)) / 5.02f;
    const float near = 1 - smooth(away / 0.08f);
    EXPECT_NEAR(trace(to_column(),
                      {{"godot.fade_off_surface", true}, {"godot.thickness", 0.08}, {"godot.relative_thickness", 0.0}})
                    .confidence,
                near * near, 2e-3);
    EXPECT_EQ(trace(to_column(), {{"godot.fade_at_border", true}}).confidence, 1);
    make_wall();
    bench.set_column(column, 10, to_left);
    bench.set_column(197, 5, to_left);
    EXPECT_NEAR(trace(to_column(), {{"godot.fade_at_border", true}}).confidence, smooth(3 * 39.5f / (14 * 14)), 1e-3);
}

}  // namespace
