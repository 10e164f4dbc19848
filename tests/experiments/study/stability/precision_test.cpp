#include "experiments/study/stability/precision/precision.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/stability/precision/double_shader.h"
#include "tests/variants/technique_fixture.h"

#include <algorithm>
#include <filesystem>

namespace {

const std::filesystem::path scenes = std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes";

const PointConfig mirror = single_point("mcguire_dda");

struct PrecisionStudy : TechniqueTest {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "precision";
    const CaseFrames& frames() {
        static const CaseFrames drawn =
            CaseDrawer(device(), {scenes}, folder, {mirror})
                .draw({.shot = {.scene = "mirror_pillars", .extent = {48, 27}, .frames = {0}}});
        return drawn;
    }
    void TearDown() override {
        std::filesystem::remove_all(folder);
        TechniqueTest::TearDown();
    }
    static PassChanges floats(std::function<bool(const std::string&)> is_double = {}) {
        const auto as_float = [](const std::string&, Format asked) { return as_float32(asked); };
        return {as_float, is_double ? double_where(std::move(is_double)) : nullptr};
    }
    PrecisionRun run(const PrecisionWish& wish) { return run_precisely(device(), mirror, frames(), wish); }
};

const PrecisionRow& find(const std::vector<PrecisionRow>& rows, PrecisionKind kind, const std::string& image,
                         const std::string& case_name = "mirror") {
    const auto row = std::ranges::find_if(
        rows, [&](const PrecisionRow& r) { return r.kind == kind && r.image == image && r.case_name == case_name; });
    if (row == rows.end()) throw std::runtime_error(std::string(name_of(kind)) + " " + image);
    return *row;
}

}  // namespace

TEST_F(PrecisionStudy, DefaultsExist) {
    const std::vector<std::string> known = list_scenes({scenes});
    for (const StabilityCase& c : read_stability_cases(precision_case_table()))
        EXPECT_TRUE(std::ranges::count(known, c.scene.shot.scene)) << c.name;
    for (const PointConfig& point : precision_points())
        EXPECT_NO_THROW(make_technique(point.technique, point.parameters, point.preset))
            << point.technique << point.point;
}

TEST_F(PrecisionStudy, DifferencesAreRelativeAndLeaveOutWhatIsNothing) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    HostImage a({5, 1}, 2), b({5, 1}, 1);
    a.values = {1, 9, 0, 9, infinity, 9, 4, 9, 1, 9}, b.values = {1, 0, 70000, 2, 1};
    std::vector<double> differences;
    add_differences(a, b, differences);
    EXPECT_EQ(differences, (std::vector{0.0, 1.0, 0.5, 0.0})) << "channels of one alone do not count";
    differences = {0.0, 0.0, 0.0, 1e-3};
    const ValueChange change = value_change(differences);
    EXPECT_EQ(change.median, 0.0);
    EXPECT_EQ(change.p999, 1e-3);
    EXPECT_EQ(change.differing, 0.25);
}

TEST_F(PrecisionStudy, NothingChangesByItself) {
    const PrecisionRun a = run({.changes = floats()}), b = run({.changes = floats()});
    EXPECT_EQ(a.specular.values, b.specular.values);
    ASSERT_EQ(a.values.size(), 3u);  // hit; radiance, confidence
    for (size_t i = 0; i < a.values.size(); ++i) {
        EXPECT_EQ(a.values[i].values.values, b.values[i].values.values) << a.values[i].image;
        EXPECT_EQ(a.values[i].format, as_float32(a.values[i].format));
    }
}

/// Device depth in half, and nothing else: standard depths of this scene lie near 1, where halves are 2^-11 apart.
TEST_F(PrecisionStudy, InputsAreStoredInHalfOneByOne) {
    const PrecisionRun narrow = run({.changes = floats(), .half_inputs = {"depth"}, .is_recording = true}),
                       wide = run({.changes = floats(), .is_recording = true});
    const HostImage& depth = frames().steps[0].host->depth;
    size_t rays = 0, moved = 0;
    for (size_t i = 0; i < wide.rays[0].rays.size(); ++i) {
        const RayRecord &a = narrow.rays[0].rays[i], &b = wide.rays[0].rays[i];
        if (a.is_traced <= 0 || b.is_traced <= 0) continue;
        ++rays, moved += a.origin != b.origin;
        EXPECT_LT(glm::distance(a.direction, b.direction), 1e-6f);  // of the pixel's centre and its normal
        const glm::vec4 clip = frames().steps[0].camera.clip_from_view * glm::vec4(a.origin, 1.0f);
        EXPECT_NEAR(clip.z / clip.w, depth.values[i], std::exp2(-11));  // cut off, at most
    }
    EXPECT_GT(rays, 300u);
    EXPECT_GT(moved, rays / 2);
}

/// Recorded rays that are traced again are those rays to the bit; in the double march they end about where they did,
/// and not everywhere to the bit.
TEST_F(PrecisionStudy, AMarchIsComparedOnTheSameRays) {
    const PrecisionRun narrow = run({.changes = floats(), .is_recording = true});
    ASSERT_EQ(narrow.rays.size(), 1u);
    const auto in_double = floats([](const std::string& stage) { return stage == "mcguire_dda/trace"; });
    const PrecisionRun drawn = run({.changes = in_double, .is_recording = true}),
                       replayed = run({.changes = in_double, .is_recording = true, .replayed = narrow.rays});
    size_t rays = 0, turned = 0, longer = 0, elsewhere = 0;
    for (size_t i = 0; i < narrow.rays[0].rays.size(); ++i) {
        const RayRecord &a = narrow.rays[0].rays[i], &b = replayed.rays[0].rays[i], &c = drawn.rays[0].rays[i];
        EXPECT_EQ(a.is_traced, b.is_traced);
        if (a.is_traced <= 0) continue;
        EXPECT_TRUE(a.origin == b.origin && a.direction == b.direction);
        EXPECT_LT(glm::distance(a.direction, c.direction), 1e-6f);  // a few roundings of float
        ++rays, turned += a.direction != c.direction, longer += a.distance != b.distance;
        elsewhere += a.pixel != b.pixel;
    }
    EXPECT_GT(rays, 300u);
    EXPECT_GT(turned, rays / 2) << "the rays of a stage in double are drawn in double";
    EXPECT_GT(longer, rays / 4);
    EXPECT_LT(elsewhere, rays / 50);
}

TEST_F(PrecisionStudy, SaysWhatEachImageAndStageCosts) {
    std::filesystem::create_directories(folder);
    const std::filesystem::path table = folder / "cases.json";
    write_text(table, R"({"cases": [{"case": "mirror", "group": "g", "why": "w", "scene": "mirror_pillars",
        "size": [48, 27], "frames": 1}]})");
    const std::vector<PrecisionRow> rows =
        run_precision(device(), {.table = table, .cases = {}, .techniques = {"mcguire_dda:default"}},
                      {.search_path = {scenes}, .cache = folder / "cache"}, [](const auto&, double) {});
    for (const PrecisionRow& row : rows) {
        EXPECT_EQ(row.refusal, "") << row.stage << row.image;
        EXPECT_EQ(row.non_finite, 0u) << row.stage << row.image;
    }
    const double error = *find(rows, PrecisionKind::method, "").error;
    EXPECT_GT(error, 0.01);
    EXPECT_EQ(*find(rows, PrecisionKind::method, "").change, 0.0);

    // Of normal halves: 2^-10 where a device cuts off, 2^-11 where it rounds.
    const PrecisionRow& hit = find(rows, PrecisionKind::half, "hit");
    EXPECT_EQ(hit.format, "rgba16f");
    EXPECT_EQ(hit.stage, "mcguire_dda/trace");
    EXPECT_GT(*hit.differing, 0.3);
    EXPECT_GT(*hit.value_p999, 1e-4);
    EXPECT_LE(*hit.value_p999, std::exp2(-10));
    EXPECT_EQ(*hit.above_half, 0.0);
    EXPECT_NEAR(*hit.share, *hit.change / error, 1e-12);
    EXPECT_EQ(find(rows, PrecisionKind::own, "confidence").format, "r8");
    EXPECT_TRUE(std::ranges::none_of(rows, [](const PrecisionRow& r) {
        return r.kind == PrecisionKind::own && r.image == "hit";  // which is in float anyway
    }));

    EXPECT_LT(*find(rows, PrecisionKind::input, "lit").share, 1e-4);

    const PrecisionRow& direction = find(rows, PrecisionKind::rays, "direction");
    EXPECT_GT(*direction.value_median, 1e-9);
    EXPECT_LT(*direction.value_p999, 1e-6);
    const PrecisionRow& march = find(rows, PrecisionKind::march, "distance");
    EXPECT_GT(*march.value_median, 1e-9);
    EXPECT_LT(*march.value_median, 1e-5);
    EXPECT_LT(*march.differing, 0.02);
    ASSERT_TRUE(march.wrong && march.wrong_in_double);
    EXPECT_GT(*march.wrong, 0.0);
    EXPECT_NEAR(*march.wrong, *march.wrong_in_double, 0.02);
}

/// Draws and densities of a lobe as narrow as alpha = 1e-3 lose digits to differences of nearly equal vectors; those of
/// a wide one hardly any.
TEST_F(PrecisionStudy, LobesLoseDigitsAsTheyNarrow) {
    const std::vector<PrecisionRow> rows = lobe_rows(device());
    const auto median = [&](const std::string& point, const std::string& function) {
        for (const PrecisionRow& row : rows)
            if (row.point == point && row.image == function) return *row.value_median;
        return -1.0;
    };
    for (const char* function : {"direction", "density", "weight", "brdf"}) {
        EXPECT_GT(median("roughness=0.1", function), 1e-9) << function;
        EXPECT_LT(median("roughness=1", function), 5e-7) << function;  // a few roundings
    }
    EXPECT_GT(median("roughness=0", "density"), 10 * median("roughness=1", "density"));
    EXPECT_GT(median("roughness=0", "brdf"), 10 * median("roughness=1", "brdf"));
}
