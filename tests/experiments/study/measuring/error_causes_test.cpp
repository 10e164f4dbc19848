// Where the error of made-up images lies, by made-up rays.
#include "experiments/study/measuring/rays/error_causes.h"
#include "variants/tracers/outcome.h"

#include <gtest/gtest.h>
#include <cmath>
#include <map>

namespace {

constexpr glm::uvec2 extent{4, 2};
const Mask everywhere{.name = "all", .extent = extent, .inside = std::vector<uint8_t>(8, 1)};

RecordedRays no_rays() { return {.stage = "trace", .rays = std::vector<RayRecord>(extent.x * extent.y)}; }

/// A ray of `pixel` that ends in a hit of the pixel (0, 0) with `confidence`.
void trace(RecordedRays& recorded, unsigned pixel, float confidence) {
    recorded.rays[pixel] = {.is_traced = 1, .confidence = confidence, .outcome = outcome_hit};
}

std::vector<ExactHit> all_meet(uint32_t outcome) {
    return std::vector<ExactHit>(extent.x * extent.y, {.position = {0.5f, 0.5f}, .distance = 1, .outcome = outcome});
}

MetricReference black_reference() { return metric_reference(HostImage(extent, 3), {}, {"mse"}, {}); }

/// An image whose squared error against black is `errors`.
HostImage with_errors(const std::vector<float>& errors) {
    HostImage image(extent, 3);
    for (size_t i = 0; i < errors.size(); ++i) image.set_rgb(i, glm::vec3(std::sqrt(errors[i])));
    return image;
}

std::map<std::string, double> shares(const ErrorCauses& causes, const std::string& mask = "all") {
    std::map<std::string, double> values;
    for (const HitRow& row : causes.rows({}))
        if (row.mask == mask) values[row.quantity.substr(7)] = row.value;
    return values;
}

}  // namespace

TEST(ErrorCauses, LieWhereThePixelsOfEachVerdictDo) {
    RecordedRays found = no_rays(), missed = no_rays();
    trace(found, 0, 1), trace(found, 2, 0.75f);
    ErrorCauses causes;
    causes.add(found, all_meet(outcome_hit), extent);  // 0: right; 2: 3/4 right, 1/4 an avoidable miss
    trace(missed, 2, 0);
    causes.finish(black_reference(), with_errors({1, 0, 4, 0, 0, 0, 0, 0}), {everywhere});
    auto of = shares(causes);
    EXPECT_NEAR(of["right"], (1 + 3) / 5.0, 1e-6);
    EXPECT_NEAR(of["avoidable_miss"], 1 / 5.0, 1e-6);

    // A later pass that traced the pixel says what became of it; the other pixels keep what they had.
    ErrorCauses later;
    later.add(found, all_meet(outcome_hit), extent);
    later.add(missed, all_meet(outcome_off_screen), extent);
    later.finish(black_reference(), with_errors({1, 0, 4, 0, 0, 0, 0, 0}), {everywhere});
    of = shares(later);
    EXPECT_NEAR(of["right"], 0.2, 1e-6);
    EXPECT_NEAR(of["unavoidable_miss"], 0.8, 1e-6);
    EXPECT_NEAR(of["avoidable_miss"], 0.0, 1e-6);
}

TEST(ErrorCauses, AreSharedWithinTwoByTwoPixelsAndElseUntraced) {
    RecordedRays rays = no_rays();
    trace(rays, 5, 1);  // (1, 1)
    ErrorCauses causes;
    causes.add(rays, all_meet(outcome_off_screen), extent);
    causes.finish(black_reference(), with_errors({1, 2, 3, 0, 0, 0, 0, 4}), {everywhere});
    auto of = shares(causes);
    EXPECT_NEAR(of["false_hit"], 0.3, 1e-6);
    EXPECT_NEAR(of["untraced"], 0.7, 1e-6);
    double sum = 0;
    for (const auto& [cause, share] : of) sum += share;
    EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(ErrorCauses, HoldNoNoiseOfTheReference) {
    // Both halves are off by as much to either side: (x - A)(x - B) = d^2 - s^2.
    const ReferenceHalves halves{.a = HostImage(extent, 3, 0.5f),
                                 .b = HostImage(extent, 3, -0.5f),
                                 .variance = HostImage(extent, 3, 0.25f),
                                 .guide = HostImage(extent, 3, 1),
                                 .samples = 16};
    RecordedRays rays = no_rays();
    trace(rays, 0, 1);
    ErrorCauses causes;
    causes.add(rays, all_meet(outcome_hit), extent);
    causes.finish(metric_reference(HostImage(extent, 3), halves, {"mse"}, {}),
                  with_errors({1.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 4.25f}), {everywhere});
    EXPECT_NEAR(shares(causes)["right"], 0.2, 1e-6);
    EXPECT_NEAR(shares(causes)["untraced"], 0.8, 1e-6);
}

TEST(ErrorCauses, AreMeansOverSeedsWithTheirInterval) {
    RecordedRays rays = no_rays();
    trace(rays, 0, 1);
    ErrorCauses causes;
    const Mask nothing{.name = "none", .extent = extent, .inside = std::vector<uint8_t>(8, 0)};
    for (const float error : {1.0f, 3.0f}) {
        causes.add(rays, all_meet(outcome_hit), extent);
        causes.finish(black_reference(), with_errors({error, 0, 0, 0, 0, 0, 0, 1}), {everywhere, nothing});
    }
    const std::vector<HitRow> rows = causes.rows({.shot = "s"});
    ASSERT_EQ(rows.size(), 7u) << "nothing lies under the other mask";
    EXPECT_EQ(rows[0].stage, error_stage);
    EXPECT_EQ(rows[0].seeds, 2u);
    EXPECT_NEAR(rows[0].value, (0.5 + 0.75) / 2, 1e-6);
    // Student's t of one degree of freedom, 12.706, times half the difference.
    EXPECT_NEAR(*rows[0].high - rows[0].value, 12.706 * 0.125, 1e-3);
}
