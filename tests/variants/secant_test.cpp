#include "tests/variants/tracer_walls_fixture.h"

// The parameters of the tracer secant, one by one.

namespace {

const nlohmann::json no_refinement = {{"secant.bisections", 0}, {"secant.secant_step", false}};
const nlohmann::json single_pixels = {{"secant.linear_steps", 4096}};

struct Secant : TracerAtWall {
    /// From whole first steps on.
    BenchEnd trace(const BenchRay& ray, std::initializer_list<nlohmann::json> parameters = {}) {
        nlohmann::json all = {{"secant.random_start", false}};
        for (const nlohmann::json& some : parameters) all.update(some);
        return bench.trace("secant", ray, all);
    }
    float along_line(float share) const { return 20.5f + share * 179.5f; }  ///< of the ray to_column(): pixels

    /// All to the right of a column, so that no step passes over it.
    void show_side(unsigned from, float distance) {
        for (unsigned x = from; x < bench.view.extent.x; ++x) bench.set_column(x, distance, to_left);
    }
};

/// A plane ends the n-th part of the line over 2^b late without the secant, and exactly with it.
TEST_F(Secant, HitsAPlaneExactlyWhereBisectionIsLate) {
    const float wall = 150.3f;
    const BenchRay ray = bench.ray_to(start, {wall, 40.5f}, 10);
    const glm::vec3 origin = bench.position(start), to_far_plane = ray.direction * ((100 - 5.02f) / (10 - 5.02f));
    const float line = std::min(bench.screen(origin + to_far_plane).x, 200.0f) - 20.5f;
    const nlohmann::json thick = {{"secant.thickness", 1e3}};
    for (const unsigned steps : {10u, 7u})
        for (const unsigned bisections : {0u, 2u, 5u}) {
            const nlohmann::json parameters = {{"secant.linear_steps", steps}, {"secant.bisections", bisections}};
            const float part = line / (float(steps) * std::exp2(float(bisections)));
            const float expected = 20.5f + part * std::ceil((wall - 20.5f) / part);
            const BenchEnd late = trace(ray, {parameters, thick, {{"secant.secant_step", false}}});
            EXPECT_TRUE(late.is_hit()) << late;
            EXPECT_NEAR(late.position.x, expected, 0.01f);
            EXPECT_GT(late.position.x - wall, 0.01f);  // not an empty test
            const BenchEnd exact = trace(ray, {parameters, thick});
            EXPECT_TRUE(exact.is_hit()) << exact;
            EXPECT_NEAR(exact.position.x, wall, 0.005f) << steps << ", " << bisections;
            EXPECT_NEAR(exact.distance, length(ray.direction), 1e-3f);
            EXPECT_EQ(exact.pixel, glm::ivec2(150, 40));
        }
    const BenchEnd in_meters = trace(ray, {thick, {{"secant.bisections", 0}, {"secant.of_device_depth", false}}});
    EXPECT_GT(std::abs(in_meters.position.x - wall), 0.2f) << in_meters;
}

TEST_F(Secant, TakesItsSteps) {
    show_side(100, 5);  // 0.443 of the line
    EXPECT_NEAR(trace(to_column(), {no_refinement}).position.x, along_line(0.5f), 0.01f);
    const nlohmann::json squares = {{"secant.exponent", 2.0}};
    EXPECT_NEAR(trace(to_column(), {no_refinement, squares}).position.x, along_line(0.49f), 0.01f);
    BenchRay ray = to_column();
    ray.random = 0.7f;
    const nlohmann::json random = {{"secant.random_start", true}};
    EXPECT_NEAR(trace(ray, {no_refinement, random}).position.x, along_line(0.47f), 0.01f);
    EXPECT_EQ(trace(to_column(), {no_refinement, {{"secant.linear_steps", 4096}}}).pixel.x, 100);  // 179 of them
}

/// The last look is half a step before the line's end, or there.
TEST_F(Secant, SearchesItsLastStep) {
    show_side(195, 5);
    BenchRay ray = to_column();
    ray.random = 0.5f;
    const nlohmann::json random = {{"secant.random_start", true}}, printed = {{"secant.search_last_step", false}};
    EXPECT_EQ(trace(ray, {random}).pixel.x, 195);
    EXPECT_EQ(trace(ray, {random, printed}).outcome, outcome_off_screen);
}

/// Between two columns' centres depth is linear, and what lies apart is not bridged.
TEST_F(Secant, ComesBehindBothSurfaces) {
    show_side(100, 5);
    const float part =
        (bench.device_depth(5.02f) - bench.device_depth(10)) / (bench.device_depth(5) - bench.device_depth(10));
    const nlohmann::json exact = {{"secant.bisections", 20}, {"secant.secant_step", false}},
                         bridged = {{"secant.split_apart", false}}, sloppy = {{"secant.both_surfaces", false}};
    const BenchEnd both = trace(to_column(), {exact, bridged}), apart = trace(to_column(), {exact}),
                   pixels = trace(to_column(), {exact, bridged, sloppy});
    EXPECT_NEAR(both.position.x, 99.5f + part, 0.01f) << both;
    EXPECT_NEAR(apart.position.x, 100, 0.01f) << apart;
    EXPECT_NEAR(pixels.position.x, 100, 0.01f) << pixels;
    EXPECT_GT(part, 0.9f);                                   // not an empty test
    EXPECT_EQ(apart.fetches - 1, 4 * (pixels.fetches - 1));  // one for the ray's own depth
}

/// Beside a column and far behind it, the ray is behind the depth between both pixels, but in front of the wall.
TEST_F(Secant, IsInFrontOfOneSurface) {
    const BenchRay ray = bench.ray_to(start, {column + 0.5f, 40.5f}, 8);
    const float rate = (1 / 5.02f - 1 / 8.0f) / float(column - start.x);  // of the inverse depth, per pixel
    const nlohmann::json parameters = {{"secant.bisections", 20}, {"secant.split_apart", false}};
    EXPECT_NEAR(trace(ray, {single_pixels, parameters}).position.x, 20.5f + (1 / 5.02f - 0.1f) / rate, 0.01f);
}

/// Beside the edge the ray meets the wall, which is far behind the depth between both.
TEST_F(Secant, MeasuresThicknessFromItsPixel) {
    show_side(100, 5);
    const BenchRay ray = bench.ray_to(start, {99.7f, 40.5f}, 10);
    const nlohmann::json bridged = {{"secant.split_apart", false}}, nearer = {{"secant.thickness_from_nearer", true}};
    EXPECT_EQ(trace(ray, {single_pixels, bridged}).pixel.x, 99);
    EXPECT_FALSE(trace(ray, {single_pixels, bridged, nearer}).is_hit());
    EXPECT_EQ(trace(ray, {single_pixels, nearer}).pixel.x, 99);
}

/// On a plane the depth between pixels is that of the plane, which no ray that leaves it comes behind.
TEST_F(Secant, LeavesItsOwnSurface) {
    std::vector<BenchRay> rays = show_floor();
    for (BenchRay& ray : rays) ray.random = 0.45f;  // steps of a pixel, to where its stair is highest
    const auto hits_with = [&](std::initializer_list<nlohmann::json> parameters) {
        nlohmann::json all = {{"secant.front_faces_only", false}, {"secant.thickness", 0.1}};
        all.update(single_pixels);
        for (const nlohmann::json& some : parameters) all.update(some);
        return hits("secant", rays, all);
    };
    const nlohmann::json printed = {{"secant.leave_own_surface", false}, {"secant.split_apart", false}},
                         sloppy = {{"secant.both_surfaces", false}};
    EXPECT_EQ(hits_with({}), 0u);
    EXPECT_EQ(hits_with({sloppy}), 0u);
    EXPECT_EQ(hits_with({printed}), 0u);
    EXPECT_GT(hits_with({printed, sloppy}), rays.size() / 20);
}

/// Behind the column by 30 cm, and then within 1 cm behind what begins at pixel 180.
TEST_F(Secant, GoesOnBehindWhatIsThin) {
    const BenchRay ray = bench.ray_to(start, {180.5f, 40.5f}, 5.4f);
    show_side(180, 5.39f);
    const auto with = [&](const char* behind) { return trace(ray, {single_pixels, {{"secant.behind", behind}}}); };
    EXPECT_EQ(with("go_on").pixel.x, 180);
    EXPECT_EQ(with("skip").pixel.x, 180);
    EXPECT_EQ(with("end").outcome, outcome_too_thick);
    EXPECT_NEAR(with("end").position.x, column, 0.1f);
    const nlohmann::json thick = {{"secant.thickness", 1.0}}, relative = {{"secant.relative_thickness", 0.2}};
    EXPECT_EQ(trace(ray, {single_pixels, thick}).pixel.x, int(column));
    EXPECT_EQ(trace(ray, {single_pixels, relative}).pixel.x, int(column));
}

/// Steps of 18 pixels go 50 cm farther behind a wall than it is thick.
TEST_F(Secant, RefinesBeforeItJudges) {
    const BenchRay ray = bench.ray_to(start, {150.3f, 40.5f}, 10);
    EXPECT_NEAR(trace(ray, {{{"secant.behind", "go_on"}}}).position.x, 150.3f, 0.01f);
    EXPECT_NEAR(trace(ray, {{{"secant.behind", "end"}}}).position.x, 150.3f, 0.01f);
    EXPECT_FALSE(trace(ray, {{{"secant.behind", "skip"}}}).is_hit());
}

/// The secant from before the wall to behind the column ends in front of something between both, too far to be a hit.
TEST_F(Secant, KeepsTheBisectionsPlace) {
    show_side(93, 9);
    show_side(100, 2);
    const nlohmann::json parameters = {{"secant.bisections", 0}, {"secant.thickness", 3.5}, {"secant.behind", "end"}};
    const BenchEnd kept = trace(to_column(), {parameters});
    EXPECT_TRUE(kept.is_hit()) << kept;
    EXPECT_NEAR(kept.position.x, along_line(0.5f), 0.01f);
    EXPECT_EQ(trace(to_column(), {parameters, {{"secant.keep_bisection", false}}}).outcome, outcome_too_thick);
}

/// A metre on it is behind the camera, from where it is projected to the other side.
TEST_F(Secant, ClipsAtTheNearPlane) {
    bench.show_wall(0.3f);
    const BenchRay ray = bench.ray_to({60, 40}, {100, 40.5f}, 0.1f);
    const nlohmann::json thick = {{"secant.thickness", 100.0}, {"secant.front_faces_only", false}};
    EXPECT_EQ(trace(ray, {thick}).outcome, outcome_behind_camera);
    const BenchEnd turned = trace(ray, {thick, {{"secant.clip_to_near_plane", false}}});
    EXPECT_TRUE(turned.is_hit()) << turned;
    EXPECT_LT(turned.position.x, 60.5f);
}

TEST_F(Secant, RejectsBackFaces) {
    for (unsigned x = column; x < 200; ++x) bench.set_column(x, 5, {1, 0, 0});
    EXPECT_EQ(trace(to_column()).outcome, outcome_from_behind);
    EXPECT_TRUE(trace(to_column(), {{{"secant.front_faces_only", false}}}).is_hit());
}

}  // namespace
