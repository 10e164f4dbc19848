// What the noise of the path-traced light that techniques read adds to their errors.
#include "experiments/study/measuring/lit_noise.h"
#include "core/gpu/device.h"
#include "experiments/study/shots/point_renders.h"
#include "groundtruth/reference/reference_cache.h"
#include "tests/experiments/study/study_fixture.h"

#include <random>

namespace {

constexpr glm::uvec2 small(48, 32);

HostImage noisy(const HostImage& truth, float deviation, std::mt19937& random) {
    // Half the variance is in few bright samples, as of paths that find a lamp by chance.
    std::normal_distribution<float> normal;
    HostImage image = truth;
    for (float& v : image.values) {
        const float rare = random() % 50 == 0 ? 7.0f : -1.0f / 7.0f;
        v += deviation * std::sqrt(0.5f) * (normal(random) + rare);
    }
    return image;
}

HostImage mean_of(const HostImage& a, const HostImage& b) {
    HostImage mean = a;
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = (a.values[i] + b.values[i]) / 2;
    return mean;
}

/// A technique that is linear in the light: each pixel shows the mean of three others.
HostImage technique(const HostImage& lit) {
    HostImage out(lit.extent, 3);
    const size_t pixels = lit.pixel_count();
    for (size_t i = 0; i < pixels; ++i)
        out.set_rgb(i, (lit.rgb((i + 50) % pixels) + lit.rgb((i + 51) % pixels) + lit.rgb((i + 74) % pixels)) / 3.0f);
    return out;
}

ResultRow row(const std::string& metric) {
    ResultRow r;
    r.frame = "0", r.target = "specular", r.metric = metric, r.mask = full_mask(small).name;
    return r;
}

}  // namespace

/// The mean of what it says is added is the mean of what is; and the interval of the rest covers.
TEST(LitNoise, IsWhatNoisyLightAddsToAnError) {
    std::mt19937 random(4);
    HostImage light(small, 3);
    for (size_t i = 0; i < light.values.size(); ++i) light.values[i] = 1 + 0.5f * std::sin(float(i) * 0.01f);
    const HostImage exact(small, 3, 0.9f);
    const MetricReference reference = metric_reference(
        exact, ReferenceHalves{.a = exact, .b = exact, .variance = HostImage(small, 3), .guide = exact, .samples = 16},
        {"mse", "bias"}, {});
    const std::vector<Mask> masks = {full_mask(small)};
    const auto score_of = [&](const HostImage& lit, size_t metric) {
        return score(reference, technique(lit), masks).at(metric).value;
    };
    const double truth[] = {score_of(light, 0), score_of(light, 1)};
    constexpr int studies = 200;
    double added = 0, excess = 0, squares = 0;
    int covered[2] = {};
    for (int study = 0; study < studies; ++study) {
        const HostImage a = noisy(light, 0.8f, random), b = noisy(light, 0.8f, random), mean = mean_of(a, b);
        LitNoiseOfErrors noises = unknown_lit_noise;
        PoseTruth pose;
        pose.targets.emplace("specular", reference);
        pose.direct = HostImage(small, 3);
        add_lit_noise_of_targets(noises, pose, {.specular = technique(a)}, {.specular = technique(b)}, masks, "0");
        std::vector<ResultRow> rows = {row("mse"), row("bias"), row("ssim")};
        set_lit_noise(rows, noises);
        ASSERT_TRUE(rows[0].lit_noise && rows[1].lit_noise && !rows[2].lit_noise);
        EXPECT_EQ(*rows[1].lit_noise, 0) << "a bias is linear: noise adds nothing on average";
        const double change = score_of(mean, 0) - truth[0] - *rows[0].lit_noise;
        added += *rows[0].lit_noise, excess += change, squares += change * change;
        for (size_t m = 0; m < 2; ++m)
            covered[m] += std::abs(score_of(mean, m) - truth[m] - *rows[m].lit_noise) <= *rows[m].lit_half_width;
    }
    EXPECT_LT(std::abs(excess), 4.5 * std::sqrt(squares)) << "false alarm 1e-5";
    EXPECT_GT(added / studies, 3 * std::sqrt(squares) / studies) << "else this shows nothing";
    // 95 % of 200 less four and a half deviations of 3.1.
    EXPECT_GE(covered[0], 176);
    EXPECT_GE(covered[1], 176);
}

/// Real techniques, of which the second draws random numbers, read light to which noise was added: what they say that
/// it adds is compared with what it does.
TEST_F(StudyTest, LitNoiseIsWhatNoisyLightAddsToRealTechniques) {
    Device device;
    write_text(folder / "study.json", R"({"shots": [{"scene": "mirror_pillars", "resolution": [48, 27]}],
        "techniques": [{"technique": "mcguire_dda"}, {"technique": "frostbite_sssr", "seeds": 2}, {"technique": "none"}],
        "metrics": "mse", "frame_metrics": [], "masks": "reflective", "targets": "specular"})");
    const Config config = read_config(folder / "study.json");
    const Shot shot = load_shot(config.shots[0], {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
    const std::unique_ptr<FrameSource> source = scene_source(device, shot, config, false);
    const ShotFrame now = shot_frame(shot, 0);
    ReferenceSettings settings;
    settings.max_samples = 32;
    const Reference reference = render_reference(shot.scene, now.scene, now.camera, shot.config.extent, settings);
    struct Result {
        double value = 0, lit_noise = 0;
    };
    const auto results = [&](const ReferenceHalves& light) {
        FrameStore store(*source, shot.config, size_t(1) << 28), lit(*source, shot.config, size_t(1) << 28);
        ShotTruth truth =
            shot_truth(shot, config, store, source->pass_list(), [&](unsigned, ReferenceUse) { return reference; });
        PoseTruth pose = *truth.poses.at(0);
        pose.diffuse = mean_of(light.a, light.b), pose.lit_halves = light;
        truth.poses[0] = std::make_shared<PoseTruth>(std::move(pose));
        std::vector<Result> all;
        for (const PointConfig& technique : config.techniques) {
            SpentTime unused;
            const Cell cell =
                render_point(device, shot, truth, lit, config, technique,
                             {.out = folder, .image_suffix = "x", .report = [](double) {}, .spent = unused});
            Result& mean = all.emplace_back();
            for (const ResultRow& r : cell.results) {
                mean.value += *r.value / double(cell.results.size());
                mean.lit_noise += *r.lit_noise / double(cell.results.size());
            }
        }
        return all;
    };
    const HostImage& light = reference.diffuse.mean;
    const std::vector<Result> clean = results({light, light});
    std::mt19937 random(9);
    constexpr int draws = 16;
    std::vector<double> unexplained[3], added[3];
    for (int draw = 0; draw < draws; ++draw) {
        const std::vector<Result> of_draw = results({noisy(light, 0.5f, random), noisy(light, 0.5f, random)});
        for (size_t v = 0; v < 3; ++v) {
            unexplained[v].push_back(of_draw[v].value - clean[v].value - of_draw[v].lit_noise);
            added[v].push_back(of_draw[v].lit_noise);
        }
    }
    for (const size_t v : {0, 1}) {
        double mean = 0, squares = 0, lit_noise = 0;
        for (const double e : unexplained[v]) mean += e / draws;
        for (const double e : unexplained[v]) squares += (e - mean) * (e - mean);
        for (const double e : added[v]) lit_noise += e / draws;
        // Student's t of 15 degrees exceeds 6 once in 4e4 runs. Frostbite's probes and clamped history decide by what
        // they read, which the first order leaves out: a fifth of what is added.
        const double deviation = std::sqrt(squares / (draws - 1) / draws);
        EXPECT_LT(std::abs(mean), 6 * deviation + (v == 1 ? 0.2 * lit_noise : 0.0)) << v << ": " << lit_noise;
        EXPECT_GT(lit_noise, 4 * deviation) << v << ": else this shows nothing";
        EXPECT_EQ(clean[v].lit_noise, 0.0);
    }
    for (const double e : added[2]) EXPECT_EQ(e, 0) << "none reads no light";
}

TEST_F(StudyTest, DirectLightHasNoNoise) {
    const std::string rest =
        R"({"shots": [{"scene": "mirror_pillars", "resolution": [48, 27]}], "reference": {"samples": 16},
        "techniques": [{"technique": "mcguire_dda"}], "metrics": "mse", "targets": "specular", "timing": {"frames": 0}, "lit": )";
    for (const char* lit : {"\"direct\"", "\"path_traced\""}) {
        write_text(folder / "study.json", rest + lit + "}");
        const auto rows =
            read_rows<ResultRow>(run(read_config(folder / "study.json"), lit[1] + std::string("out")) / "results.csv");
        ASSERT_FALSE(rows.empty());
        for (const ResultRow& r : rows) EXPECT_EQ(r.lit_noise.has_value(), lit[1] == 'p') << r.mask;
    }
}

TEST_F(StudyTest, LitNoiseIsLeftOutWhereAskedAndSaidToBe) {
    const auto study = [&](const std::string& reference, const std::string& out) {
        write_text(
            folder / "study.json",
            R"({"shots": [{"scene": "roughness_gradient", "resolution": [48, 27]}], "techniques": [{"technique": "mcguire_dda"}],
        "metrics": "mse", "targets": "specular", "timing": {"frames": 0}, "reference": )" +
                reference + "}");
        return run(read_config(folder / "study.json"), out);
    };
    const auto with = study(R"({"samples": 16})", "with"),
               without = study(R"({"samples": 16, "lit_noise": false})", "without");
    const auto rows = read_rows<ResultRow>(with / "results.csv"), left = read_rows<ResultRow>(without / "results.csv");
    ASSERT_EQ(rows.size(), left.size());
    size_t known = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].value, left[i].value);
        EXPECT_FALSE(left[i].lit_noise);
        known += rows[i].lit_noise.has_value();
    }
    EXPECT_GT(known, 0u);
    EXPECT_NE(read_text(without / "report.html").find("did not measure what the noise of the lit colour adds"),
              std::string::npos);
}
