#include "tests/variants/denoiser_scene.h"
#include "tests/variants/denoiser_tolerance.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>

// The fast form of the denoiser against the faithful one, where golden data does not reach: sizes that are no multiples
// of a tile, reversed depth, the corrections.

namespace {

struct Case {
    const char* name;
    glm::uvec2 extent;
    DepthDirection direction;
    nlohmann::json parameters = nlohmann::json::object();
};

nlohmann::json with_form(nlohmann::json parameters, const char* form) {
    parameters["denoiser_form"] = form;
    parameters["barrier_before_average"] = true;
    return parameters;
}

struct AmdDenoiserForms : TechniqueTest, testing::WithParamInterface<Case> {
    AmdDenoiserBench faithful{device(), GetParam().extent, with_form(GetParam().parameters, "faithful")};
    AmdDenoiserBench fast{device(), GetParam().extent, with_form(GetParam().parameters, "fast")};

    /// Holds the fast form's image to the faithful one's and replaces it by that, so that each pass is fed alike.
    void compare(const std::string& what, const DenoiserInputs& inputs, const Image& expected, const Image& found,
                 const Tolerance& tolerance) {
        const HostImage golden = faithful.pass_list.download(expected);
        const bool is_of_tiles = golden.extent == inputs.tiles.extent;
        expect_near(
            what, fast.pass_list.download(found), golden,
            [&](unsigned x, unsigned y) {
                if (is_of_tiles) return *inputs.tiles.pixel(x, y) > 0;
                return *inputs.tiles.pixel(x / 8, y / 8) > 0 && *inputs.roughness.pixel(x, y) < 0.2f;
            },
            tolerance);
        fast.pass_list.upload(found, golden);
    }
};

const nlohmann::json all_corrections = {
    {"current_sample_count", true}, {"no_dark_exit", true},          {"running_variance", true},
    {"round_up_tiles", true},       {"relative_depth_weight", true}, {"reproject_history_depth", true},
    {"guard_previous_clip", true},  {"finite_neighborhood", true},   {"fresh_neighborhood", true}};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

}  // namespace

TEST_P(AmdDenoiserForms, GiveTheSame) {
    std::vector<DenoiserInputs> frames;
    for (unsigned index = 0; index < 4; ++index) {
        frames.push_back(floor_and_ball(GetParam().extent, GetParam().direction, index, index > 0 ? index - 1 : 0));
        const DenoiserInputs& now = frames.back();
        const DenoiserInputs* before = index > 0 ? &frames[index - 1] : nullptr;
        const std::string frame = " of frame " + std::to_string(index);
        for (AmdDenoiserBench* bench : {&faithful, &fast}) bench->begin_frame(now, before);
        const AmdHistories &a = faithful.histories, &b = fast.histories;
        for (AmdDenoiserBench* bench : {&faithful, &fast})
            amd_reproject(bench->pass_list, bench->gbuffer, bench->work, bench->histories, bench->denoiser);
        compare("reprojected" + frame, now, faithful.reprojected(), fast.reprojected(), interpolated);
        compare("variance" + frame, now, a.variance.current, b.variance.current, squared_change);
        compare("count" + frame, now, a.sample_count.current, b.sample_count.current, one_half);
        compare("average" + frame, now, a.average_radiance.current, b.average_radiance.current, one_small_float);
        for (AmdDenoiserBench* bench : {&faithful, &fast})
            amd_prefilter(bench->pass_list, bench->work, bench->histories, bench->denoiser);
        compare("prefiltered" + frame, now, a.radiance.previous, b.radiance.previous, one_half);
        compare("prefiltered variance" + frame, now, a.variance.previous, b.variance.previous, squared_change);
        for (AmdDenoiserBench* bench : {&faithful, &fast})
            amd_resolve_temporal(bench->pass_list, bench->work, bench->histories, bench->denoiser);
        compare("resolved" + frame, now, a.radiance.current, b.radiance.current, one_half);
        compare("resolved variance" + frame, now, a.variance.current, b.variance.current, squared_change);
    }
}

INSTANTIATE_TEST_SUITE_P(amd_denoiser, AmdDenoiserForms,
                         testing::Values(Case{"odd_size", {125, 83}, DepthDirection::standard},
                                         Case{"reversed_depth", {125, 83}, DepthDirection::reversed},
                                         Case{"corrected", {125, 83}, DepthDirection::standard, all_corrections}),
                         [](const auto& info) { return std::string(info.param.name); });

namespace {

struct AmdDenoiserFloat16 : TechniqueTest {
    /// What the denoiser shows of the last of some frames, each fed by the form's own.
    HostImage resolved(const char* form, const std::vector<DenoiserInputs>& frames) {
        AmdDenoiserBench bench(device(), frames.front().depth.extent, with_form({}, form));
        HostImage image;
        for (size_t i = 0; i < frames.size(); ++i) {
            bench.begin_frame(frames[i], i > 0 ? &frames[i - 1] : nullptr);
            amd_denoise(bench.pass_list, bench.gbuffer, bench.work, bench.histories, bench.denoiser);
            image = bench.pass_list.download(bench.histories.radiance.current);
        }
        return image;
    }
};

}  // namespace

/// Sums of 81 halves are off by some 2^-11 sqrt(81) = 0.4 % of themselves, and most of that cancels in their ratio.
/// They decide only where history is clipped.
TEST_F(AmdDenoiserFloat16, ComesCloseToTheFaithfulForm) {
    std::vector<DenoiserInputs> frames;
    for (unsigned index = 0; index < 6; ++index)
        frames.push_back(floor_and_ball({125, 83}, DepthDirection::standard, index, index > 0 ? index - 1 : 0));
    const HostImage expected = resolved("faithful", frames), found = resolved("float16", frames);
    double difference = 0, size = 0;
    for (size_t i = 0; i < expected.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double value = expected.rgb(i)[c];
            difference += (found.rgb(i)[c] - value) * (found.rgb(i)[c] - value), size += value * value;
        }
    EXPECT_LT(std::sqrt(difference / size), 0.004);
    EXPECT_GT(difference, 0) << "in the same arithmetic";
}

/// Whether bright or dark, noisy or flat, history is clipped as in floats: to within a hundredth of the colours, of
/// which halves have a thousandth.
TEST_F(AmdDenoiserFloat16, ClipsHistoryAtEveryBrightness) {
    for (const float brightness : {0.02f, 1.0f, 200.0f, 5000.0f})
        for (const float noise : {0.0f, 0.005f}) {
            FacingWall before, now;
            before.color = [=](unsigned, unsigned) { return glm::vec3(1.4f * brightness); };
            now.color = [=](unsigned x, unsigned y) {
                return glm::vec3(brightness * (1 + noise * float((x * 7 + y * 13) % 5)));
            };
            std::vector<DenoiserInputs> frames(8, facing_wall(before));
            frames.push_back(facing_wall(now));
            const HostImage expected = resolved("faithful", frames), found = resolved("float16", frames);
            for (size_t i = 0; i < found.pixel_count(); ++i)
                ASSERT_NEAR(found.rgb(i).g, expected.rgb(i).g, 0.01f * brightness)
                    << i << ", " << brightness << ", " << noise;
        }
}

/// Squares of the differences between 0 and 60000 are no halves: no history is clipped, and nothing becomes infinite.
TEST_F(AmdDenoiserFloat16, StaysFinite) {
    FacingWall wall;
    wall.color = [](unsigned x, unsigned) { return glm::vec3(x % 2 ? 60000 : 0); };
    const HostImage found = resolved("float16", std::vector(3, facing_wall(wall)));
    for (size_t i = 0; i < found.pixel_count(); ++i) {
        ASSERT_GE(found.rgb(i).g, 0) << i;
        ASSERT_LE(found.rgb(i).g, 60000) << i;
    }
}
