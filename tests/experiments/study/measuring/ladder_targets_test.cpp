// Rungs of the truth ladder as targets of studies, and their own errors against the truth.
#include "core/error.h"
#include "core/json.h"
#include "experiments/study/measuring/rung_errors.h"
#include "groundtruth/reference/reference_file.h"
#include "tests/experiments/study/study_fixture.h"

#include <cmath>
#include <random>

namespace {

/// Images of one value, without noise.
ReferenceOutput constant(glm::uvec2 extent, float value) {
    const HostImage image(extent, 3, value);
    return {image, image, image, HostImage(extent, 3)};
}

Reference flat_reference(glm::uvec2 extent = {16, 16}) {
    Reference reference;
    reference.extent = extent;
    reference.diffuse = constant(extent, 0.25f), reference.image = constant(extent, 0.65f);
    reference.specular = constant(extent, 0.4f), reference.incident = constant(extent, 0.8f);
    reference.ladder.camera_radiance = constant(extent, 0.6f), reference.ladder.on_screen = constant(extent, 0.5f);
    reference.ladder.reflectance = HostImage(extent, 3, 0.5f);
    for (TruthLadder::ErrorVariance* error :
         {&reference.ladder.camera_radiance_error, &reference.ladder.on_screen_error})
        *error = {HostImage(extent, 3), HostImage(extent, 3)};
    reference.highlights = reference.normal = HostImage(extent, 3);
    reference.depth = HostImage(extent, 1);
    reference.material_id = HostImage(extent, 1, 1.0f), reference.sample_count = HostImage(extent, 1, 16.0f);
    reference.guide = {reference.specular.mean, reference.incident.mean, reference.diffuse.mean};
    return reference;
}

PoseTruth truth_of(const Reference& reference, const std::vector<std::string>& targets,
                   const std::vector<std::string>& metrics = {"mse", "relmse", "bias", "flip"}) {
    Config config;
    config.targets = targets, config.metrics = metrics;
    return pose_truth(reference, config, 0.0f, {.has_targets = true});
}

nlohmann::json entry_of(const nlohmann::json& entries, const std::string& rung, const std::string& target,
                        const std::string& metric, const std::string& mask = "all") {
    for (const nlohmann::json& e : entries)
        if (e["rung"] == rung && e["target"] == target && e["metric"] == metric && e["mask"] == mask) return e;
    ADD_FAILURE() << "no entry of " << rung << " " << target << " " << metric << " " << mask;
    return {{"value", NAN}, {"low", NAN}, {"high", NAN}};
}

/// The value of a row of the only seed.
double row_value(const std::vector<ResultRow>& rows, const std::string& technique, const std::string& target,
                 const std::string& metric, const std::string& mask) {
    for (const ResultRow& r : rows)
        if (r.technique == technique && r.target == target && r.metric == metric && r.mask == mask && r.seed == 0)
            return r.value.value();
    ADD_FAILURE() << "no row " << technique << " " << target << " " << metric << " " << mask;
    return NAN;
}

const std::string with_ladder = R"(, "targets": ["specular", "incident", "camera_radiance", "on_screen"], )"
                                R"("metrics": ["mse", "relmse", "bias"])";

}  // namespace

TEST(LadderTargets, EachComparesTheIncidentRadianceWithItsRung) {
    const PoseTruth truth = truth_of(flat_reference(), {"incident", "camera_radiance", "on_screen"});
    const HostImage tested({16, 16}, 3, 0.7f), other({16, 16}, 3, 9.0f);
    const std::vector<Mask> masks = {full_mask({16, 16})};
    std::map<std::string, double> mse;
    for (const ResultRow& r : measure_targets(truth, {other, tested, HostImage({16, 16}, 1)}, masks, {}))
        if (r.metric == "mse") mse[r.target] = r.value.value();
    EXPECT_NEAR(mse["incident"], 0.01, 1e-7);
    EXPECT_NEAR(mse["camera_radiance"], 0.01, 1e-7);
    EXPECT_NEAR(mse["on_screen"], 0.04, 1e-7);
}

TEST(LadderTargets, RungsErrByTheirDistanceFromEachTarget) {
    const PoseTruth truth =
        truth_of(flat_reference(), {"specular", "image", "incident", "camera_radiance", "on_screen"});
    const std::vector<Mask> masks = {full_mask({16, 16}), {.name = "hit", .extent = {16, 16}, .inside = {}}};
    const nlohmann::json entries = rung_entries(truth, masks);
    EXPECT_EQ(entries.size(), 2u * 3u * 3u) << "rungs x targets x metrics without FLIP; a technique's mask has none";
    const auto value = [&](const char* target, const char* metric, const char* rung = "on_screen") {
        return entry_of(entries, rung, target, metric)["value"].get<double>();
    };
    // 0.5 against 0.8; times a reflectance of 0.5; and on top of a diffuse light of 0.25. Floats are exact to 1e-7.
    EXPECT_NEAR(value("incident", "mse"), 0.09, 1e-6);
    EXPECT_NEAR(value("incident", "bias"), -0.3, 1e-6);
    EXPECT_NEAR(value("incident", "relmse"), 0.09 / (0.64 + 0.01), 1e-6);
    EXPECT_NEAR(value("specular", "mse"), 0.0225, 1e-6);
    EXPECT_NEAR(value("specular", "relmse"), 0.0225 / (0.16 + 0.01), 1e-6);
    EXPECT_NEAR(value("image", "mse"), 0.0225, 1e-6);
    EXPECT_NEAR(value("image", "relmse"), 0.0225 / (0.65 * 0.65 + 0.01), 1e-6);
    EXPECT_NEAR(value("incident", "mse", "camera_radiance"), 0.04, 1e-6);
}

TEST(LadderTargets, SharedNoiseCancelsAndTheRestIsInTheInterval) {
    // Noise of 0.3 that rung and truth share, and of 0.05 that the rung has alone.
    std::mt19937 random(11);
    std::normal_distribution<float> shared(0, 0.3f), own(0, 0.05f);
    constexpr int count = 60;
    int holds = 0;
    double mean = 0, half_width = 0;
    for (int image = 0; image < count; ++image) {
        Reference reference = flat_reference({64, 64});
        for (auto half : {&ReferenceOutput::half_a, &ReferenceOutput::half_b})
            for (size_t i = 0; i < reference.incident.mean.values.size(); ++i) {
                const float noise = shared(random);
                (reference.incident.*half).values[i] += noise;
                (reference.ladder.on_screen.*half).values[i] += noise + own(random);
            }
        for (ReferenceOutput* output : {&reference.incident, &reference.ladder.on_screen})
            output->variance = HostImage(reference.extent, 3, 0.045f);
        reference.ladder.on_screen_error.incident = HostImage(reference.extent, 3, 0.00125f);
        const PoseTruth truth = truth_of(reference, {"incident", "on_screen"}, {"mse"});
        const std::vector<Mask> masks = {full_mask(reference.extent)};
        const nlohmann::json entry = entry_of(rung_entries(truth, masks), "on_screen", "incident", "mse");
        const double low = entry["low"], high = entry["high"];
        holds += low <= 0.09 && 0.09 <= high;
        mean += (low + high) / 2 / count, half_width += (high - low) / 2 / count;
    }
    // The product of two differences of 0.3 with noises of 0.05 has the variance 2 0.3^2 0.05^2 + 0.05^4.
    const double deviation = std::sqrt((2 * 0.09 * 0.0025 + 0.0025 * 0.0025) / (64 * 64 * 3));
    EXPECT_NEAR(mean, 0.09, 6 * deviation / std::sqrt(count));
    EXPECT_NEAR(half_width, 1.96 * deviation, 0.05 * deviation) << "of 4096 pixels each scatters by 1 %";
    EXPECT_GE(holds, 57 - 4.2 * 1.7) << "95 % of 60: a false alarm of 1e-4, and the seed is fixed";
}

TEST_F(StudyTest, InAFurnaceTheScreenTellsAll) {
    // All rays of this sphere end in the sky, which the fallback is exactly: no rung loses anything.
    const fs::path out = run(config(R"("furnace_sphere")", with_ladder), "a");
    const nlohmann::json entries = read_json(out / "manifest.json")["shots"][0]["truth_ladder"];
    for (const char* rung : {"camera_radiance", "on_screen"})
        EXPECT_NEAR(entry_of(entries, rung, "incident", "mse", "reflective")["value"].get<double>(), 0.0, 1e-9) << rung;
    const auto rows = read_rows<ResultRow>(out / "results.csv");
    for (const char* target : {"incident", "camera_radiance", "on_screen"})
        EXPECT_NEAR(row_value(rows, "none", target, "mse", "reflective"), 0.0, 1e-6) << target;
}

TEST_F(StudyTest, WhatTheScreenShowsIsTheTruthWhereItShowsAll) {
    // Mirror rays of this floor meet flat pillars and a flat wall that the image shows, or the constant sky: nothing is
    // hidden, so all rungs are one.
    const fs::path out = run(config(R"("mirror_pillars")", with_ladder), "a");
    const nlohmann::json entries = read_json(out / "manifest.json")["shots"][0]["truth_ladder"];
    const auto rows = read_rows<ResultRow>(out / "results.csv");
    const double none = row_value(rows, "none", "incident", "mse", "reflective");
    const nlohmann::json limit = entry_of(entries, "on_screen", "incident", "mse", "reflective");
    // Samples are shared, and what is met radiates alike in all directions.
    EXPECT_EQ(entry_of(entries, "camera_radiance", "incident", "mse", "reflective")["value"], 0.0);
    // The far tails of the mirror's lobe (alpha = 0.001) meet what is off the screen, one sample in some thousands.
    EXPECT_LT(std::abs(limit["value"].get<double>()), 1e-3 * none);
    const double traced = row_value(rows, "mcguire_dda", "incident", "mse", "reflective");
    EXPECT_GT(traced, 0.0);
    EXPECT_NEAR(row_value(rows, "mcguire_dda", "on_screen", "mse", "reflective"), traced, 0.05 * traced);
}

TEST_F(StudyTest, AWallThatHidesBoundsWhatSsrCanDo) {
    const Config study = config(R"("offscreen_mirror")", with_ladder);
    const fs::path out = run(study, "a");
    const nlohmann::json manifest = read_json(out / "manifest.json");
    const auto rows = read_rows<ResultRow>(out / "results.csv");
    const nlohmann::json& entries = manifest["shots"][0]["truth_ladder"];
    const nlohmann::json limit = entry_of(entries, "on_screen", "specular", "mse", "reflective");
    EXPECT_GT(limit["low"].get<double>(), 0.0) << "most of what this mirror shows is behind the camera";
    EXPECT_LT(limit["high"].get<double>(), row_value(rows, "none", "specular", "mse", "reflective"))
        << "what the image shows of it is more than nothing";
    for (const char* technique : {"none", "mcguire_dda"})
        EXPECT_LT(row_value(rows, technique, "on_screen", "mse", "reflective"),
                  0.5 * row_value(rows, technique, "incident", "mse", "reflective"))
            << "the rung forgives what no technique can know";
    size_t splits = 0, references = 0, maps = 0;
    for (const SplitRow& s : read_rows<SplitRow>(out / "splits.csv")) splits += s.target == "on_screen";
    for (const nlohmann::json& i : manifest["images"])
        if (i["target"] == "on_screen") ++(i["kind"] == "reference" ? references : maps);
    EXPECT_GT(splits, 0u);
    EXPECT_EQ(references, 1u);
    EXPECT_EQ(maps, 2u) << "the error of both techniques";

    // A killed run ends with the same rows, and with the same ladder though all cells are there.
    const std::string first = read_text(out / "results.csv");
    fs::remove(folder / "a/results.csv"), fs::remove(folder / "a/manifest.json");
    EXPECT_EQ(read_text(run(study, "a") / "results.csv"), first);
    EXPECT_EQ(read_json(out / "manifest.json")["shots"][0]["truth_ladder"], entries);
}

TEST_F(StudyTest, OnlyTheMeasuredFrameHasALadderAndOtherReferencesStay) {
    const auto references = [&] {
        std::map<std::string, bool> found;
        for (const auto& entry : fs::directory_iterator(folder / "cache"))
            if (entry.path().extension() == ".exr")
                found[entry.path().filename().string()] = !read_reference(entry.path()).ladder.is_empty();
        return found;
    };
    Config study = config(R"("moving_emitter")");
    study.shots.front().frames = {4, 5};
    run(study, "plain");
    const auto plain = references();
    ASSERT_EQ(plain.size(), 2u);
    study.targets = {"specular", "on_screen"};
    const fs::path out = run(study, "ladder");
    const auto both = references();
    EXPECT_EQ(both.size(), 3u) << "that of frame 4 needs no ladder and is taken from the cache";
    for (const auto& [name, has_ladder] : plain) EXPECT_FALSE(has_ladder) << name;
    EXPECT_EQ(std::ranges::count_if(both, [](const auto& r) { return r.second; }), 1);
    for (const ResultRow& r : read_rows<ResultRow>(out / "results.csv"))
        if (r.target == "on_screen") {
            EXPECT_EQ(r.frame, "5");
        }
}

TEST_F(StudyTest, UnknownTargetsAndReferencesWithoutLadderAreMistakes) {
    const auto message = [&](const std::function<void()>& act) -> std::string {
        try {
            act();
        } catch (const Error& e) {
            return e.what();
        }
        return "nothing was wrong";
    };
    EXPECT_NE(message([&] { config(R"("fence")", R"(, "targets": ["on_scren"])"); }).find("did you mean 'on_screen'?"),
              std::string::npos);
    EXPECT_NE(message([&] { config(R"("fence")", R"(, "targets": ["split_sum"])"); }).find("\"split_sum\""),
              std::string::npos);
    const std::string common =
        "cd '" + folder.string() + "' && SSRLAB_CACHE='" + (folder / "cache").string() + "' '" SSRLAB_PROGRAM "' ";
    ASSERT_EQ(std::system((common + "gbuffer fence --size 48 27 --out capture > log 2>&1").c_str()), 0);
    const auto capture = [&](const std::string& options) {
        EXPECT_EQ(std::system(
                      (common + "reference fence --size 48 27 --samples 16 --out truth.exr " + options + " > log 2>&1")
                          .c_str()),
                  0);
        write_text(folder / "capture.json",
                   R"({"shots": [{"gbuffer": "capture", "reference": "truth.exr"}], "targets": ["on_screen"],
                       "techniques": [{"technique": "none"}], "timing": {"frames": 0}})");
        return message([&] { run(read_config(folder / "capture.json"), "a"); });
    };
    EXPECT_NE(capture("").find("truth.exr has no truth ladder"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "a/results.csv"));
    EXPECT_EQ(capture("--ladder"), "nothing was wrong");
}
