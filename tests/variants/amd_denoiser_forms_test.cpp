#include "tests/variants/denoiser_scene.h"
#include "tests/variants/denoiser_tolerance.h"
#include "tests/variants/variant_fixture.h"

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

struct AmdDenoiserForms : VariantTest, testing::WithParamInterface<Case> {
    DenoiserBench faithful{device(), GetParam().extent, with_form(GetParam().parameters, "faithful")};
    DenoiserBench fast{device(), GetParam().extent, with_form(GetParam().parameters, "fast")};

    /// Holds the fast form's image to the faithful one's and replaces it by that, so that each pass is fed alike.
    void compare(const std::string& what, const DenoiserInputs& inputs, const Image& expected, const Image& found,
                 const Tolerance& tolerance) {
        const HostImage golden = faithful.graph.download(expected);
        const bool is_of_tiles = golden.extent == inputs.tiles.extent;
        expect_near(
            what, fast.graph.download(found), golden,
            [&](unsigned x, unsigned y) {
                if (is_of_tiles) return *inputs.tiles.pixel(x, y) > 0;
                return *inputs.tiles.pixel(x / 8, y / 8) > 0 && *inputs.roughness.pixel(x, y) < 0.2f;
            },
            tolerance);
        fast.graph.upload(found, golden);
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
        for (DenoiserBench* bench : {&faithful, &fast}) bench->begin_frame(now, before);
        const AmdHistories &a = faithful.histories, &b = fast.histories;
        for (DenoiserBench* bench : {&faithful, &fast})
            amd_reproject(bench->graph, bench->gbuffer, bench->work, bench->histories, bench->denoiser);
        compare("reprojected" + frame, now, faithful.reprojected(), fast.reprojected(), interpolated);
        compare("variance" + frame, now, a.variance.current, b.variance.current, squared_change);
        compare("count" + frame, now, a.sample_count.current, b.sample_count.current, one_half);
        compare("average" + frame, now, a.average_radiance.current, b.average_radiance.current, one_small_float);
        for (DenoiserBench* bench : {&faithful, &fast})
            amd_prefilter(bench->graph, bench->work, bench->histories, bench->denoiser);
        compare("prefiltered" + frame, now, a.radiance.previous, b.radiance.previous, one_half);
        compare("prefiltered variance" + frame, now, a.variance.previous, b.variance.previous, squared_change);
        for (DenoiserBench* bench : {&faithful, &fast})
            amd_resolve_temporal(bench->graph, bench->work, bench->histories, bench->denoiser);
        compare("resolved" + frame, now, a.radiance.current, b.radiance.current, one_half);
        compare("resolved variance" + frame, now, a.variance.current, b.variance.current, squared_change);
    }
}

INSTANTIATE_TEST_SUITE_P(amd_denoiser, AmdDenoiserForms,
                         testing::Values(Case{"odd_size", {125, 83}, DepthDirection::standard},
                                         Case{"reversed_depth", {125, 83}, DepthDirection::reversed},
                                         Case{"corrected", {125, 83}, DepthDirection::standard, all_corrections}),
                         [](const auto& info) { return std::string(info.param.name); });
