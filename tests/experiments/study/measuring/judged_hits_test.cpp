// Verdicts of rays made by hand, and the rows made of them.
#include "experiments/study/measuring/rays/judged_hits.h"
#include "metrics/statistics/estimates.h"
#include "variants/tracers/outcome.h"

#include <gtest/gtest.h>
#include <cmath>
#include <map>
#include <random>

namespace {

using enum RayVerdict;

RayRecord hit_at(glm::uvec2 pixel, float confidence = 1, float distance = 1) {
    return {.is_traced = 1, .confidence = confidence, .distance = distance, .outcome = outcome_hit, .pixel = pixel};
}
RayRecord miss(uint32_t outcome = outcome_background) { return {.is_traced = 1, .outcome = outcome}; }

const ExactHit seen_at_3_3{.position = {3.5f, 3.5f}, .distance = 1, .outcome = outcome_hit};
const ExactHit off_screen{.distance = 1, .outcome = outcome_off_screen};
const ExactHit nothing{.distance = 1, .outcome = outcome_background};

const Mask everywhere{.name = "all"};

/// Rows of one seed or more, by quantity.
struct Quantities {
    std::vector<HitRow> rows;

    const HitRow& row(const std::string& quantity, const std::string& mask = "all") const {
        for (const HitRow& r : rows)
            if (r.quantity == quantity && r.mask == mask) return r;
        ADD_FAILURE() << "no row " << quantity << " " << mask;
        return rows.at(0);
    }
    double operator()(const std::string& quantity, const std::string& mask = "all") const {
        return row(quantity, mask).value;
    }
    bool has(const std::string& quantity) const { return std::ranges::count(rows, quantity, &HitRow::quantity) > 0; }
};

struct JudgedRay {
    RayRecord ray;
    ExactHit truth;
};

void add(JudgedHits& judged, unsigned seed, const std::vector<JudgedRay>& rays, glm::uvec2 extent, unsigned every = 1,
         const std::vector<Mask>& masks = {everywhere}, const std::string& stage = "trace", unsigned per_pixel = 1) {
    RecordedRays recorded{.stage = stage, .rays_per_pixel = per_pixel};
    std::vector<ExactHit> truth;
    for (const JudgedRay& r : rays) recorded.rays.push_back(r.ray), truth.push_back(r.truth);
    judged.add(seed, recorded, truth, extent, every, masks);
}

Quantities judged(const std::vector<JudgedRay>& rays) {
    JudgedHits hits;
    add(hits, 0, rays, {unsigned(rays.size()), 1});
    return {hits.rows({})};
}

}  // namespace

TEST(JudgedHits, AHitIsRightWithinOnePixel) {
    const ExactHit truth{.position = {10.2f, 7.9f}, .distance = 1, .outcome = outcome_hit};  // in pixel 10, 7
    for (const glm::uvec2 pixel : {glm::uvec2(10, 7), {11, 8}, {9, 6}, {9, 8}})
        EXPECT_EQ(verdict_of_hit(hit_at(pixel), truth), right) << pixel.x << ", " << pixel.y;
    for (const glm::uvec2 pixel : {glm::uvec2(12, 7), {8, 7}, {10, 9}, {10, 5}, {0, 0}})
        EXPECT_EQ(verdict_of_hit(hit_at(pixel), truth), wrong_place) << pixel.x << ", " << pixel.y;
}

TEST(JudgedHits, EachTruthHasItsVerdict) {
    struct Line {
        uint32_t outcome;
        RayVerdict of_hit, of_miss;
    };
    for (const Line& line : {Line{outcome_hit, right, avoidable_miss},
                             {outcome_off_screen, false_hit, unavoidable_miss},
                             {outcome_behind_camera, false_hit, unavoidable_miss},
                             {outcome_hidden, false_hit, unavoidable_miss},
                             {outcome_background, false_hit, empty},
                             {outcome_own_surface, false_hit, empty}}) {
        const ExactHit truth{.position = {3.5f, 3.5f}, .outcome = line.outcome};
        EXPECT_EQ(verdict_of_hit(hit_at({3, 3}), truth), line.of_hit) << line.outcome;
        EXPECT_EQ(verdict_of_miss(truth), line.of_miss) << line.outcome;
    }
}

TEST(JudgedHits, ConfidenceDividesARayBetweenHitAndMiss) {
    const Quantities shares = judged({{hit_at({3, 3}, 0.25f), seen_at_3_3},
                                      {hit_at({9, 9}, 0.5f), seen_at_3_3},
                                      {hit_at({3, 3}, 0.75f), off_screen},
                                      {hit_at({3, 3}, 0.125f), nothing}});
    EXPECT_DOUBLE_EQ(shares("right"), 0.25 / 4);
    EXPECT_DOUBLE_EQ(shares("wrong_place"), 0.5 / 4);
    EXPECT_DOUBLE_EQ(shares("avoidable_miss"), (0.75 + 0.5) / 4);
    EXPECT_DOUBLE_EQ(shares("false_hit"), (0.75 + 0.125) / 4);
    EXPECT_DOUBLE_EQ(shares("unavoidable_miss"), 0.25 / 4);
    EXPECT_DOUBLE_EQ(shares("empty"), 0.875 / 4);
    EXPECT_DOUBLE_EQ(shares("correct"), (0.25 + 0.25 + 0.875) / 4);
    EXPECT_DOUBLE_EQ(shares("miss: hit"), (0.75 + 0.5) / 4) << "what the confidence leaves";

    RayRecord unsure_miss = miss();  // confidence of what is no hit means nothing
    unsure_miss.confidence = 1;
    EXPECT_DOUBLE_EQ(judged({{unsure_miss, seen_at_3_3}})("avoidable_miss"), 1);
}

TEST(JudgedHits, TheSixVerdictsAddUpToOne) {
    std::mt19937 random(1);
    const auto below = [&](unsigned count) { return unsigned(random()) % count; };
    std::vector<JudgedRay> rays;
    for (unsigned i = 0; i < 500; ++i) {
        RayRecord ray = hit_at({below(5), below(5)}, 0.01f * float(below(101)));
        ray.outcome = below(2) ? uint32_t(outcome_hit) : below(outcome_count);
        rays.push_back(
            {ray, {.position = {2.5f, 2.5f}, .outcome = below(2) ? uint32_t(outcome_hit) : below(outcome_count)}});
    }
    const Quantities shares = judged(rays);
    double sum = 0, misses = 0;
    for (const char* name : ray_verdict_names()) {
        EXPECT_GT(shares(name), 0) << name;
        sum += shares(name);
    }
    EXPECT_NEAR(sum, 1, 1e-13) << "500 sums in double precision";
    EXPECT_NEAR(shares("correct"), shares("right") + shares("unavoidable_miss") + shares("empty"), 1e-15);
    for (const HitRow& r : shares.rows)
        if (r.quantity.starts_with("miss: ")) misses += r.value;
    EXPECT_NEAR(misses, shares("avoidable_miss"), 1e-13) << "each has its outcome";
}

TEST(JudgedHits, AvoidableMissesAreToldByTheTracersOutcome) {
    const Quantities shares = judged({{miss(outcome_too_thick), seen_at_3_3},
                                      {miss(outcome_too_thick), seen_at_3_3},
                                      {miss(outcome_unfinished), seen_at_3_3},
                                      {miss(outcome_from_behind), off_screen}});
    EXPECT_DOUBLE_EQ(shares("miss: too_thick"), 0.5);
    EXPECT_DOUBLE_EQ(shares("miss: unfinished"), 0.25);
    EXPECT_FALSE(shares.has("miss: from_behind")) << "that one could not be avoided";
}

TEST(JudgedHits, OnlyTracedRaysCount) {
    const Quantities shares =
        judged({{hit_at({3, 3}), seen_at_3_3}, {RayRecord{}, seen_at_3_3}, {miss(), seen_at_3_3}});
    EXPECT_DOUBLE_EQ(shares("right"), 0.5);
    EXPECT_DOUBLE_EQ(shares.row("right").rays, 2);
    JudgedHits none;
    add(none, 0, {{RayRecord{}, seen_at_3_3}}, {1, 1});
    EXPECT_TRUE(none.rows({}).empty());
}

TEST(JudgedHits, DistancesAreThoseOfRightHits) {
    const auto seen_from = [](float distance) {
        ExactHit truth = seen_at_3_3;
        truth.distance = distance;
        return truth;
    };
    const Quantities shares = judged({{hit_at({3, 3}, 1, 2.2f), seen_from(2)},     // 0.1
                                      {hit_at({3, 3}, 0.5f, 3.0f), seen_from(4)},  // 0.25
                                      {hit_at({3, 3}, 1, 1.5f), seen_from(1)},     // 0.5
                                      {hit_at({9, 9}, 1, 7), seen_from(1)},        // elsewhere
                                      {hit_at({3, 3}, 0, 7), seen_from(1)},        // no hit
                                      {hit_at({3, 3}, 1, 7), off_screen}});
    EXPECT_FLOAT_EQ(float(shares("distance_error")), 0.25f);
    EXPECT_FALSE(judged({{miss(), seen_at_3_3}}).has("distance_error"));
}

TEST(JudgedHits, FetchesAreAMeanOverRays) {
    RayRecord few = hit_at({3, 3}), many = miss();
    few.fetches = 4, many.fetches = 9;
    EXPECT_DOUBLE_EQ(judged({{few, seen_at_3_3}, {many, nothing}})("fetches"), 6.5);
}

TEST(JudgedHits, FetchesHaveADistributionOverRays) {
    std::vector<JudgedRay> rays;
    for (unsigned i = 0; i < 20; ++i) {
        rays.push_back({miss(), nothing});
        rays.back().ray.fetches = (7 * i) % 20;  // 0 to 19, in no order
    }
    const Quantities found = judged(rays);
    EXPECT_DOUBLE_EQ(found("fetches: median"), 10);
    EXPECT_DOUBLE_EQ(found("fetches: 90 %"), 18);
    EXPECT_DOUBLE_EQ(found("fetches: most"), 19);
}

TEST(JudgedHits, MasksAndTheGridChoosePixels) {
    // 4 x 4 pixels with two rays each; the first of both is a hit where x and y are even, all others miss.
    std::vector<JudgedRay> rays;
    for (unsigned y = 0; y < 4; ++y)
        for (unsigned x = 0; x < 4; ++x) {
            const bool is_hit = x % 2 == 0 && y % 2 == 0;
            rays.push_back({is_hit ? hit_at({3, 3}) : miss(), seen_at_3_3});
            rays.push_back({miss(), seen_at_3_3});
        }
    Mask row{.name = "row", .extent = {4, 4}, .inside = std::vector<uint8_t>(16)};
    for (unsigned x = 0; x < 4; ++x) row.inside[4 * 2 + x] = 1;
    JudgedHits all, one_in_two;
    add(all, 0, rays, {4, 4}, 1, {everywhere, row}, "trace", 2);
    add(one_in_two, 0, rays, {4, 4}, 2, {everywhere, row}, "trace", 2);
    const Quantities of_all{all.rows({})}, of_grid{one_in_two.rows({})};
    EXPECT_DOUBLE_EQ(of_all.row("right").rays, 32);
    EXPECT_DOUBLE_EQ(of_all("right"), 4.0 / 32);
    EXPECT_DOUBLE_EQ(of_all.row("right", "row").rays, 8);
    EXPECT_DOUBLE_EQ(of_all("right", "row"), 2.0 / 8);
    EXPECT_DOUBLE_EQ(of_grid.row("right").rays, 8);
    EXPECT_DOUBLE_EQ(of_grid("right"), 4.0 / 8);
    EXPECT_DOUBLE_EQ(of_grid.row("right", "row").rays, 4);
    EXPECT_DOUBLE_EQ(of_grid("right", "row"), 2.0 / 4);
}

TEST(JudgedHits, SeedsGiveAMeanWithTheIntervalOfCountsWhereFewRaysChange) {
    // 1, 2 and 2 of 4 rays are right; another pass has rays with one of the seeds only.
    JudgedHits hits;
    const std::array<unsigned, 3> right_of_seed = {1, 2, 2};
    for (unsigned seed = 0; seed < 3; ++seed) {
        std::vector<JudgedRay> rays;
        for (unsigned i = 0; i < 4; ++i)
            rays.push_back({i < right_of_seed[seed] ? hit_at({3, 3}) : miss(), seen_at_3_3});
        add(hits, 10 + seed, rays, {4, 1});
        add(hits, 10 + seed, {{seed == 1 ? miss() : RayRecord{}, seen_at_3_3}}, {1, 1}, 1, {everywhere}, "rough");
    }
    const HitRow shared{.shot = "shot", .frame = "7", .technique = "technique", .point = "point"};
    const std::vector<HitRow> rows = hits.rows(shared);
    const HitRow& first = rows.at(0);
    EXPECT_EQ(first.quantity, "right");
    EXPECT_EQ(first.stage + first.shot + first.frame + first.technique + first.point, "traceshot7techniquepoint");
    EXPECT_EQ(first.seeds, 3u);
    EXPECT_DOUBLE_EQ(first.rays, 4);
    EXPECT_DOUBLE_EQ(first.value, 5.0 / 12);
    // The scatter is that of one changed ray: 5 of 12 rays, give or take 1.9208 + 1.96 sqrt(1 + 0.9604) = 4.6651.
    EXPECT_NEAR(first.low.value(), (5 - 4.6651) / 12, 1e-5);
    EXPECT_NEAR(first.high.value(), (5 + 4.6651) / 12, 1e-5);
    const auto rough = std::ranges::find(rows, "rough", &HitRow::stage);
    ASSERT_NE(rough, rows.end());
    EXPECT_EQ(rough->seeds, 1u) << "seeds without a ray say nothing";
    EXPECT_DOUBLE_EQ(rough->rays, 1);
    EXPECT_FALSE(rough->low || rough->high);
}

/// Rays of `seeds` seeds, of which that many are right and all others avoidable misses.
Quantities with_right(const std::vector<unsigned>& right, unsigned rays_per_seed) {
    JudgedHits hits;
    for (unsigned seed = 0; seed < right.size(); ++seed) {
        std::vector<JudgedRay> rays;
        for (unsigned i = 0; i < rays_per_seed; ++i)
            rays.push_back({i < right[seed] ? hit_at({3, 3}, 1, 1 + 0.01f * float(seed)) : miss(), seen_at_3_3});
        add(hits, seed, rays, {rays_per_seed, 1});
    }
    return {hits.rows({})};
}

TEST(JudgedHits, IntervalsAreStudentsWhereManyRaysChange) {
    const HitRow row = with_right({100, 200, 300}, 400).row("right");
    const Estimate student = mean_estimate(std::vector<double>{0.25, 0.5, 0.75});
    EXPECT_DOUBLE_EQ(row.low.value(), std::max(student.low, 0.0));
    EXPECT_DOUBLE_EQ(row.high.value(), std::min(student.high, 1.0));
}

TEST(JudgedHits, WhatNoSeedShowedIsNotExcluded) {
    // Of a Poisson mean of which nothing was counted Wilson's interval ends at z^2 = 3.84 (the exact one at 3.69).
    const HitRow row = with_right({0, 0, 0, 0}, 100).row("right");
    EXPECT_EQ(row.low, 0.0);
    EXPECT_NEAR(row.high.value(), 3.8416 / 400, 1e-9);
}

TEST(JudgedHits, IntervalsOfRareVerdictsHoldTheirShare) {
    std::mt19937 random(1);
    constexpr unsigned trials = 2000, rays = 100;
    for (const double share : {0.001, 0.01, 0.1}) {
        std::binomial_distribution<unsigned> right(rays, share);
        unsigned covered = 0;
        for (unsigned trial = 0; trial < trials; ++trial) {
            const HitRow row =
                with_right({right(random), right(random), right(random), right(random)}, rays).row("right");
            covered += *row.low <= share && share <= *row.high;
        }
        // 95 % less four standard deviations of the count: one false alarm in 30000 if it covers just so. Student's
        // covers 0.34, 0.98 and 0.95.
        EXPECT_GE(covered, 0.95 * trials - 4 * std::sqrt(0.95 * 0.05 * trials)) << share;
    }
}

TEST(JudgedHits, DistancesAndFetchesHaveNoIntervalOfFewSeedsOrRays) {
    for (const auto& [seeds, rays, has_interval] :
         {std::tuple(3u, 40u, false), {4u, 19u, false}, {4u, 20u, true}, {4u, 40u, true}}) {
        const Quantities quantities = with_right(std::vector<unsigned>(seeds, rays), rays);
        for (const char* quantity : {"distance_error", "fetches"})
            EXPECT_EQ(quantities.row(quantity).low.has_value(), has_interval) << quantity << seeds << " " << rays;
        EXPECT_TRUE(quantities.row("right").low.has_value());
    }
    const Quantities few_right = with_right({10, 10, 10, 10}, 40);
    EXPECT_FALSE(few_right.row("distance_error").low) << "a median of 10 rays";
    EXPECT_TRUE(few_right.row("fetches").low);
    const HitRow row = with_right({40, 40, 40, 40}, 40).row("distance_error");
    EXPECT_NEAR(row.high.value(), mean_estimate(std::vector<double>{0, 0.01, 0.02, 0.03}).high, 1e-6);
}

TEST(JudgedHits, MapsShowTheFirstRayOfEachPixel) {
    const std::vector<JudgedRay> rays = {{hit_at({3, 3}), seen_at_3_3}, {hit_at({9, 9}), seen_at_3_3},
                                         {hit_at({3, 3}), nothing},     {miss(), seen_at_3_3},
                                         {miss(), off_screen},          {miss(), nothing},
                                         {RayRecord{}, seen_at_3_3},    {hit_at({3, 3}, 0.4f), seen_at_3_3}};
    RecordedRays recorded{.rays_per_pixel = 2};
    std::vector<ExactHit> truth;
    for (const JudgedRay& r : rays) {
        recorded.rays.insert(recorded.rays.end(), {r.ray, miss()});
        truth.insert(truth.end(), {r.truth, off_screen});
    }
    const HostImage map = map_of_verdicts(recorded, truth, {unsigned(rays.size()), 1});
    // Okabe and Ito's colours; a power of 2.2 is what sRGB decodes by, to less than 3 codes.
    const std::vector<glm::vec3> expected = {{0, 158, 115}, {230, 159, 0},   {204, 121, 167}, {240, 228, 66},
                                             {0, 114, 178}, {128, 128, 128}, {0, 0, 0},       {240, 228, 66}};
    for (size_t i = 0; i < expected.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double linear = map.rgb(i)[c];
            const double code =
                255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
            EXPECT_NEAR(code, expected[i][c], 3) << i << ", " << c;
        }
}
