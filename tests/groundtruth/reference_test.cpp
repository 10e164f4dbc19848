// References: their halves and variances, their stops, their states and the cache.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/scene/load_scene.h"
#include "groundtruth/reference/reference_cache.h"
#include "groundtruth/reference/reference_error.h"
#include "groundtruth/reference/reference_file.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;

namespace {

constexpr glm::uvec2 extent(32, 18);

struct References : testing::Test {
    fs::path folder = fs::temp_directory_path() / "reference_test";
    Scene scene = load_scene("roughness_gradient", {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
    ScenePose pose = pose_scene(scene, 0);
    CameraPose camera = pose_camera(scene.cameras.front(), pose, 0);

    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }

    Reference render(const ReferenceSettings& settings, const ReferenceRun& run = {}) const {
        return render_reference(scene, pose, camera, extent, settings, run);
    }
};

ReferenceSettings samples(unsigned count, unsigned seed = 1) { return {.max_samples = count, .seed = seed}; }

/// Mean over all values of (a - b)^2 / (variance of a + variance of b), where there is any variance.
double mean_z_squared(const ReferenceOutput& a, const ReferenceOutput& b) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < a.mean.values.size(); ++i) {
        const double variance = double(a.variance.values[i]) + b.variance.values[i];
        if (variance <= 0) continue;
        sum += std::pow(double(a.mean.values[i]) - b.mean.values[i], 2) / variance;
        ++count;
    }
    return sum / double(count);
}

double mean_of(const HostImage& image) {
    double sum = 0;
    for (const float v : image.values) sum += v;
    return sum / double(image.values.size());
}

/// The mean variance of pixels relative to their squared radiance and that of the image.
double relative_noise(const ReferenceOutput& output) {
    const double all = mean_of(output.mean);
    double sum = 0;
    for (size_t i = 0; i < output.mean.values.size(); ++i)
        sum += double(output.variance.values[i]) / (std::pow(double(output.mean.values[i]), 2) + 0.01 * all * all);
    return sum / double(output.mean.values.size());
}

/// Of independent samples: pixels differ by what their variances say, and the whole images by no more than 4.5 standard
/// errors (false alarm 1e-5), of which the three channels, which share their paths, count as one.
void expect_same_mean(const ReferenceOutput& a, const ReferenceOutput& b) {
    const double z = mean_z_squared(a, b);  // bounds as in OfOtherSeedsDifferByTheirStatedVariance
    EXPECT_GT(z, 0.7);
    EXPECT_LT(z, 1.4);
    const double count = double(a.mean.values.size()), variance = mean_of(a.variance) + mean_of(b.variance);
    EXPECT_LT(std::abs(mean_of(a.mean) - mean_of(b.mean)), 4.5 * std::sqrt(3 * variance / count));
}

}  // namespace

TEST_F(References, AreTheSameBitsForAnyNumberOfThreads) {
    const Reference four = render(samples(64));
    Reference one;
    tbb::task_arena(1).execute([&] { one = render(samples(64)); });
    EXPECT_EQ(one.specular.mean.values, four.specular.mean.values);
    EXPECT_EQ(one.incident.variance.values, four.incident.variance.values);
}

TEST_F(References, AreTheMeanOfTheirHalves) {
    const Reference r = render(samples(64));
    for (const ReferenceOutput* output : {&r.image, &r.diffuse, &r.specular})
        for (size_t i = 0; i < output->mean.values.size(); ++i)
            EXPECT_NEAR(output->mean.values[i], 0.5f * (output->half_a.values[i] + output->half_b.values[i]),
                        1e-6f + 1e-6f * std::abs(output->mean.values[i]));  // float32 rounding of three numbers
    for (size_t i = 0; i < r.image.mean.values.size(); ++i)
        EXPECT_NEAR(r.image.mean.values[i],
                    r.diffuse.mean.values[i] + r.specular.mean.values[i] + r.highlights.values[i],
                    1e-6f + 1e-6f * r.image.mean.values[i]);
    EXPECT_EQ(r.non_finite_samples, 0u);
}

TEST_F(References, OfOtherSeedsDifferByTheirStatedVariance) {
    // z^2 of two renders with about 30 degrees of freedom has mean 30/28 if batch means are normal. Rare bright paths
    // make it smaller. Over some 700 noisy values its own standard error is sqrt(2 / 700) = 5 %: the bounds are 6 of
    // them.
    const double z = mean_z_squared(render(samples(256, 1)).specular, render(samples(256, 2)).specular);
    EXPECT_GT(z, 0.7);
    EXPECT_LT(z, 1.4);
}

TEST_F(References, StoppedByTheirErrorAreUnbiased) {
    ReferenceSettings adaptive{.max_samples = 4096, .target_relative_error = 0.03f, .seed = 3};
    const Reference stopped = render(adaptive), fixed = render(samples(2048, 4));
    const double z = mean_z_squared(stopped.specular, fixed.specular);
    EXPECT_GT(z, 0.6);
    EXPECT_LT(z, 1.5);
    // The means over the image agree to 1 %: each pixel is known to 3 %, and there are hundreds.
    EXPECT_NEAR(mean_of(stopped.specular.mean) / mean_of(fixed.specular.mean), 1.0, 0.01);
    EXPECT_GT(stopped.reached_share, 0.8f);
}

TEST_F(References, WithAnAdaptiveShareAreTheSameHoweverTheyAreRendered) {
    ReferenceSettings settings{.max_samples = 1024, .lit_samples = 64, .adaptive_share = 0.5f, .seed = 1};
    const Reference plain = render({.max_samples = 1024, .lit_samples = 64, .seed = 2});
    for (const bool for_image : {false, true}) {
        SCOPED_TRACE(for_image);
        settings.adaptive_image = for_image;
        const auto noise = [&](const Reference& r) {
            return for_image ? relative_noise(r.image) : mean_of(r.specular.variance);
        };
        const Reference whole = render(settings);
        EXPECT_GT(std::ranges::max(whole.directions.values), 1.0f);
        EXPECT_EQ(std::ranges::min(whole.directions.values), 1.0f);
        expect_same_mean(whole.image, plain.image);
        expect_same_mean(whole.incident, plain.incident);
        EXPECT_LT(noise(whole), 0.6 * noise(plain));  // found: 0.18 and 0.44; directions of the wrong pixels leave 1
        const auto expect_same = [&](const Reference& other, const char* what) {
            EXPECT_EQ(other.specular.mean.values, whole.specular.mean.values) << what;
            EXPECT_EQ(other.image.variance.values, whole.image.variance.values) << what;
            EXPECT_EQ(other.directions.values, whole.directions.values) << what;
        };
        Reference one;
        tbb::task_arena(1).execute([&] { one = render(settings); });
        expect_same(one, "one thread");

        struct Stop {};
        fs::create_directories(folder);
        ReferenceRun run{.state_file = folder / "state.exr", .seconds_between_saves = 0, .seconds_between_reports = 0};
        run.progress = [reports = 0](double fraction, double, double) mutable {
            if (fraction > 0.3 && fraction < 1 && ++reports > 2) throw Stop{};
        };
        EXPECT_THROW(render(settings, run), Stop);
        run.progress = {};
        expect_same(render(settings, run), "stopped and continued");

        const auto cached = [&](unsigned samples) {
            ReferenceSettings wanted = settings;
            wanted.max_samples = samples;
            return cached_reference(scene, pose, camera, extent, wanted, folder);
        };
        cached(512);
        expect_same(cached(1024), "samples added to a file");
        EXPECT_TRUE(cached(1024).from_cache);
        fs::remove_all(folder);
    }
    ReferenceSettings other = settings;
    other.adaptive_share = 1;
    const auto stream = [&](const ReferenceSettings& s) { return reference_stream(scene, pose, camera, extent, s); };
    EXPECT_NE(stream(other), stream(settings));
    other = settings, other.adaptive_image = false;
    EXPECT_NE(stream(other), stream(settings));
    for (ReferenceSettings wrong : {ReferenceSettings{.adaptive_share = -1},
                                    {.adaptive_share = 9},
                                    {.adaptive_share = 0.5f, .target_relative_error = 0.1f},
                                    {.adaptive_share = 0.5f, .lit_only = true}})
        EXPECT_THROW(render(wrong), Error);
}

TEST_F(References, AreNotStoppedByALimitThatNobodySet) {
    EXPECT_EQ(reference_key("s", {}), "s-n256");
    EXPECT_EQ(reference_key("s", {.max_seconds = 2}), "s-n16777216-t2");
    EXPECT_EQ(reference_key("s", {.max_samples = 1000, .target_relative_error = 0.25f}), "s-n1024-e0.25");
    const Reference targeted = render({.target_relative_error = 0.04f});
    EXPECT_GT(std::ranges::max(targeted.sample_count.values), 256.0f);
    EXPECT_GT(targeted.reached_share, 0.8f);  // 0.2 with 256 samples
}

TEST_F(References, ContinueWhereTheyWereStopped) {
    const Reference whole = render(samples(1024));
    struct Stop {};
    ReferenceRun run;
    fs::create_directories(folder);
    run.state_file = folder / "state.exr";
    run.seconds_between_reports = 0;
    run.seconds_between_saves = 0;
    int reports = 0;
    run.progress = [&](double fraction, double, double) {
        if (fraction > 0.3 && ++reports > 3) throw Stop{};
    };
    EXPECT_THROW(render(samples(1024), run), Stop);
    EXPECT_TRUE(fs::exists(run.state_file));
    double last = 0;
    run.progress = [&](double fraction, double, double left) {
        if (last == 0) {
            EXPECT_LT(fraction, 0.9) << "it goes on where it was";
        }
        EXPECT_GE(fraction, last);
        EXPECT_GE(left, 0.0);
        last = fraction;
    };
    const Reference continued = render(samples(1024), run);
    EXPECT_GT(last, 0.9);
    EXPECT_EQ(continued.specular.mean.values, whole.specular.mean.values);
    EXPECT_EQ(continued.image.variance.values, whole.image.variance.values);
}

TEST_F(References, WithATargetContinueWhereTheyWereStopped) {
    const ReferenceSettings settings{.max_samples = 8192, .target_relative_error = 0.03f, .seed = 1};
    const Reference whole = render(settings);
    struct Stop {};
    fs::create_directories(folder);
    ReferenceRun run{.state_file = folder / "state.exr", .seconds_between_saves = 0, .seconds_between_reports = 0};
    int reports = 0, stops = 0;
    run.progress = [&](double, double, double) {
        if (++reports % 300 == 0) throw Stop{};  // a pass is 576 pixels at most: between them, and within
    };
    Reference continued;
    for (bool is_done = false; !is_done;) try {
            continued = render(settings, run);
            is_done = true;
        } catch (const Stop&) {
            ++stops;
        }
    EXPECT_GE(stops, 2);
    EXPECT_EQ(continued.sample_count.values, whole.sample_count.values);
    EXPECT_EQ(continued.specular.mean.values, whole.specular.mean.values);
    EXPECT_EQ(continued.image.variance.values, whole.image.variance.values);
}

TEST_F(References, WithATimeLimitAreExtendedByMoreTime) {
    const auto cached = [&](const ReferenceSettings& settings) {
        return cached_reference(scene, pose, camera, extent, settings, folder);
    };
    for (const float target : {0.0f, 0.02f}) {
        const Reference first = cached({.max_samples = 512, .max_seconds = 0.001, .target_relative_error = target});
        const Reference more = cached({.max_samples = 512, .max_seconds = 100, .target_relative_error = target / 2});
        EXPECT_FALSE(more.from_cache);
        EXPECT_TRUE(more.passes.starts_with(first.passes)) << first.passes << " and " << more.passes;
        EXPECT_GT(more.rays, first.rays);
        for (size_t i = 0; i < first.sample_count.values.size(); ++i)
            EXPECT_GE(more.sample_count.values[i], first.sample_count.values[i]);
        fs::remove_all(folder);
    }
}

TEST_F(References, WithoutATimeLimitHaveTheBitsOfTheirKey) {
    const auto cached = [&](const ReferenceSettings& settings) {
        return cached_reference(scene, pose, camera, extent, settings, folder);
    };
    const ReferenceSettings coarse{.target_relative_error = 0.2f}, fine{.target_relative_error = 0.1f};
    cached(coarse);
    EXPECT_EQ(cached(fine).specular.mean.values, render(fine).specular.mean.values);  // rendered anew
    // From 64 all is rendered anew, for a render of its own begins with 256 at once; these are extended to 512.
    cached(samples(64));
    for (const unsigned count : {256u, 512u})
        EXPECT_EQ(cached(samples(count)).specular.mean.values, render(samples(count)).specular.mean.values) << count;
}

TEST_F(References, AreCachedByContent) {
    const auto cached = [&](const ReferenceSettings& settings) {
        return cached_reference(scene, pose, camera, extent, settings, folder);
    };
    const Reference first = cached(samples(64));
    EXPECT_FALSE(first.from_cache);
    const Reference again = cached(samples(64));
    EXPECT_TRUE(again.from_cache);
    EXPECT_EQ(again.specular.mean.values, first.specular.mean.values);
    EXPECT_EQ(again.lobe_samples.values, first.lobe_samples.values);
    EXPECT_FALSE(cached(samples(64, 9)).from_cache);
    camera.vertical_fov *= 1.1f;
    EXPECT_FALSE(cached(samples(64)).from_cache);
    scene.content_hash = "another scene";
    EXPECT_FALSE(cached(samples(64)).from_cache);
    for (const auto& file : fs::directory_iterator(folder))
        if (file.path().extension() == ".exr") fs::resize_file(file.path(), 1000);
    EXPECT_FALSE(cached(samples(64)).from_cache);  // truncated: rendered anew
    EXPECT_TRUE(cached(samples(64)).from_cache);
}

TEST_F(References, SurviveTheirFile) {
    Reference r = render(samples(64));
    const std::vector<float> specular = r.specular.mean.values, normal = r.normal.values;
    write_reference(folder / "r.exr", r, samples(64));
    const Reference back = read_reference(folder / "r.exr");
    EXPECT_EQ(back.specular.mean.values, specular);
    EXPECT_EQ(back.normal.values, normal);
    EXPECT_EQ(back.extent, extent);
    EXPECT_THROW(read_reference(folder / "none.exr"), Error);
}

TEST_F(References, HaveTheSameGuideWhateverTheirSamplesAre) {
    const Reference first = render(samples(16));
    const auto expect_same = [&](const Reference& other, const char* what) {
        EXPECT_EQ(other.guide.specular.values, first.guide.specular.values) << what;
        EXPECT_EQ(other.guide.incident.values, first.guide.incident.values) << what;
        EXPECT_EQ(other.guide.diffuse.values, first.guide.diffuse.values) << what;
    };
    expect_same(render(samples(16, 99)), "another seed");
    expect_same(render(samples(256)), "more samples");
    expect_same(render({.max_samples = 64, .target_relative_error = 0.5f, .seed = 1}), "a target");
    expect_same(render({.max_samples = 16, .seed = 1, .ladder = true}), "a ladder");
    expect_same(render({.max_samples = 16, .seed = 1, .keep_all = true}), "nothing left out");
    Reference one;
    tbb::task_arena(1).execute([&] { one = render(samples(16)); });
    expect_same(one, "one thread");
    const auto cached = [&](unsigned count) {
        return cached_reference(scene, pose, camera, extent, samples(count), folder);
    };
    expect_same(cached(256), "a file");
    expect_same(cached(512), "samples added to a file");
    expect_same(cached(512), "the file of those");
    // Nothing is reflected twice in this scene, but much is between mirrors.
    const Scene mirrors = load_scene("facing_mirrors", {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
    const ScenePose mirrors_pose = pose_scene(mirrors, 0);
    const CameraPose mirrors_camera = pose_camera(mirrors.cameras.front(), mirrors_pose, 0);
    const auto guide = [&](unsigned max_depth) {
        return render_reference(mirrors, mirrors_pose, mirrors_camera, extent,
                                {.max_samples = 16, .max_depth = max_depth})
            .guide.specular.values;
    };
    EXPECT_NE(guide(1), guide(4));
}

TEST_F(References, AreIndependentOfTheirGuide) {
    // If a seed's samples were the guide's, its noise would be the guide's: their difference from a good reference has
    // no correlation but for that of chance, 1 / sqrt(500 noisy pixels), six of which are 0.27.
    const Reference good = render(samples(4096, 77));
    for (const unsigned seed : {0u, 1u, 0x9d1deu}) {
        const Reference r = render(samples(64, seed));
        double products = 0, squares = 0, guide_squares = 0;
        for (size_t i = 0; i < r.specular.mean.values.size(); ++i) {
            if (good.specular.variance.values[i] == 0) continue;
            const double deviation = std::sqrt(double(good.specular.variance.values[i]));
            const double own = (double(r.specular.mean.values[i]) - good.specular.mean.values[i]) / deviation;
            const double guide = (double(r.guide.specular.values[i]) - good.specular.mean.values[i]) / deviation;
            const auto bounded = [](double z) { return std::clamp(z, -30.0, 30.0); };  // no pixel decides alone
            products += bounded(own) * bounded(guide);
            squares += bounded(own) * bounded(own), guide_squares += bounded(guide) * bounded(guide);
        }
        EXPECT_LT(std::abs(products / std::sqrt(squares * guide_squares)), 0.27) << seed;
    }
}

TEST_F(References, OfTheLitColorAloneHaveItsLightAndNoOther) {
    const ReferenceSettings lit_only{.max_samples = 256, .seed = 1, .lit_only = true};
    Reference lit = render(lit_only);
    const Reference whole = render(samples(1024, 2));
    EXPECT_TRUE(lit.is_lit_only());
    EXPECT_FALSE(whole.is_lit_only());
    for (const HostImage* image : {&lit.image.mean, &lit.specular.mean, &lit.incident.mean, &lit.guide.specular})
        EXPECT_TRUE(image->values.empty());
    EXPECT_NE(lit.stream, render(samples(256, 1)).stream);  // no cache takes one for the other
    // As in OfOtherSeedsDifferByTheirStatedVariance, but over 192 noisy pixels, whose channels share their paths.
    const double z = mean_z_squared(lit.diffuse, whole.diffuse);
    EXPECT_GT(z, 0.5);
    EXPECT_LT(z, 1.7);
    EXPECT_NEAR(mean_of(lit.diffuse.mean) / mean_of(whole.diffuse.mean), 1.0, 0.01);
    EXPECT_LT(lit.rays, 0.25 * 0.8 * whole.rays);  // a quarter of the samples, and of these the diffuse paths
    EXPECT_EQ(lit.normal.values, whole.normal.values);

    const std::vector<float> half = lit.diffuse.half_b.values;
    write_reference(folder / "lit.exr", lit, lit_only);
    const Reference back = read_reference(folder / "lit.exr");
    EXPECT_TRUE(back.is_lit_only());
    EXPECT_EQ(back.diffuse.half_b.values, half);
    EXPECT_EQ(back.hash, lit.hash);
    EXPECT_THROW(render({.max_samples = 16, .lit_only = true, .ladder = true}), Error);
    EXPECT_THROW(render({.target_relative_error = 0.1f, .lit_only = true}), Error);
}

TEST_F(References, HaveABudgetForTheLitColour) {
    constexpr ReferenceSettings settings{.max_samples = 1024, .lit_samples = 64, .seed = 1};
    const Reference r = render(settings), few = render(samples(64, 1)), whole = render(samples(1024, 2));
    // Its first samples are those of a reference that has no more; then the specular light goes on alone.
    EXPECT_EQ(r.diffuse.mean.values, few.diffuse.mean.values);
    EXPECT_EQ(r.diffuse.variance.values, few.diffuse.variance.values);
    EXPECT_LT(r.rays, 0.8 * whole.rays)
        << "15 of 16 diffuse paths are not traced, and those are more than a fifth of the rays here";
    EXPECT_NE(r.stream, render(samples(16, 1)).stream);  // no cache takes one for the other
    expect_same_mean(r.specular, whole.specular);
    expect_same_mean(r.image, whole.image);
    for (size_t i = 0; i < r.image.mean.values.size(); ++i)
        for (const auto half : {&ReferenceOutput::half_a, &ReferenceOutput::half_b, &ReferenceOutput::mean})
            ASSERT_NEAR((r.image.*half).values[i],
                        (r.diffuse.*half).values[i] + (r.specular.*half).values[i] + r.highlights.values[i],
                        1e-5f * (1 + (r.image.*half).values[i]));  // float32 rounding of two numbers

    ReferenceSettings more = settings;
    more.max_samples = 2048;
    EXPECT_EQ(cached_reference(scene, pose, camera, extent, settings, folder).specular.mean.values,
              r.specular.mean.values);
    EXPECT_EQ(cached_reference(scene, pose, camera, extent, more, folder).image.variance.values,
              render(more).image.variance.values)
        << "extended from the file";
    EXPECT_THROW(render({.max_samples = 16, .lit_samples = 16, .lit_only = true}), Error);
}

TEST_F(References, WithFewGuideSamplesAreUnbiased) {
    const ReferenceSettings settings{.max_samples = 1024, .seed = 1, .guide_samples = 16};
    const Reference r = render(settings), whole = render(samples(1024, 2));
    EXPECT_NE(r.guide.specular.values, whole.guide.specular.values);
    expect_same_mean(r.specular, whole.specular);
    EXPECT_THROW(render({.max_samples = 16, .guide_samples = 0}), Error);
}

TEST_F(References, OfVersionsWithoutAnAdaptiveShareHaveNone) {
    Reference r = render(samples(16));
    write_reference(folder / "new.exr", r, samples(16));
    LayeredImage layers = read_exr(folder / "new.exr");
    for (const char* name : {"ssrlab.adaptive_share", "ssrlab.adaptive_image"})
        EXPECT_EQ(layers.attributes.erase(name), 1u);
    write_exr(folder / "old.exr", layers);
    EXPECT_EQ(read_reference_state(folder / "old.exr").settings.adaptive_share, 0);
}

TEST_F(References, WithoutAGuideSayWhatToDo) {
    Reference r = render(samples(16));
    write_reference(folder / "new.exr", r, samples(16));
    LayeredImage layers = read_exr(folder / "new.exr");
    std::erase_if(layers.layers, [](const Layer& layer) { return layer.name.starts_with("guide."); });
    write_exr(folder / "old.exr", layers);
    const std::string message = error_message([&] { read_reference(folder / "old.exr"); });
    EXPECT_NE(message.find("old.exr lacks the layer 'guide.specular'"), std::string::npos) << message;
    EXPECT_NE(message.find("render it again with `ssrlab reference`"), std::string::npos) << message;
}

TEST(ReferenceOfNothing, IsTheSkyExactly) {
    const Scene sky = load_scene("sky_only", {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
    const ScenePose pose = pose_scene(sky, 0);
    const CameraPose camera = pose_camera(sky.cameras.front(), pose, 0);
    const Reference r = render_reference(sky, pose, camera, extent, samples(16));
    for (size_t i = 0; i < r.image.mean.pixel_count(); ++i) EXPECT_EQ(r.image.mean.rgb(i), sky.environment.color);
    EXPECT_EQ(mean_of(r.specular.mean), 0.0);
    EXPECT_THROW(render_reference(sky, pose, camera, {0, 4}, samples(16)), Error);
}

TEST_F(References, KeepHighlightsApart) {
    pose.lights.push_back({.intensity = glm::vec3(100), .position = {0, 3, 0}});
    const Reference a = render(samples(64, 1)), b = render(samples(64, 2));
    EXPECT_EQ(a.highlights.values, b.highlights.values);  // they have no noise
    EXPECT_GT(mean_of(a.highlights), 0.001);
    for (size_t i = 0; i < a.image.mean.values.size(); ++i) {
        const double sum = double(a.diffuse.mean.values[i]) + a.specular.mean.values[i] + a.highlights.values[i];
        EXPECT_NEAR(a.image.mean.values[i], sum, 1e-6 + 1e-6 * sum);  // float32 rounding
    }
}
