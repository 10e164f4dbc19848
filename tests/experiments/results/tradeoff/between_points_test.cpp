#include "experiments/results/tradeoff/between_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/results/files/markdown.h"
#include "experiments/results/tradeoff/numpy_random.h"

// Curves, draws and fits of `ssrlab tradeoff`, by closed forms.

namespace {

/// `half`: of the error's interval; `spread`: of the times, relative; all points are slow in the same frames.
MeasuredPoint point(const std::string& technique, double error, double half, double cost, double spread = 0,
                    std::vector<double> seeds = {}) {
    MeasuredPoint p;
    p.row.technique = technique, p.row.point = std::to_string(cost), p.row.verdict = "front";
    p.row.error = error, p.row.error_low = error - half, p.row.error_high = error + half;
    if (seeds.empty()) seeds = {error};
    for (size_t i = 0; i < seeds.size(); ++i) p.seeds.emplace_back(unsigned(i), seeds[i]);
    for (unsigned frame = 0; frame < 15; ++frame)
        p.rounds[{0, frame}] = cost * (1 + spread * (double((7 * frame) % 15) - 7) / 7);
    p.row.cost = cost;
    return p;
}

struct Made {
    std::vector<MeasuredPoint> points;
    std::vector<const MeasuredPoint*> pointers() const {
        std::vector<const MeasuredPoint*> found;
        for (const MeasuredPoint& p : points) found.push_back(&p);
        return found;
    }
    Draws draws(size_t count = 2000) const { return draws_of(pointers(), 1, count); }
    Curve curve(size_t count = 2000) const {
        std::vector<size_t> rows(points.size());
        for (size_t i = 0; i < rows.size(); ++i) rows[i] = i;
        return {pointers(), draws(count), rows};
    }
};

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return quantile_of(values, share);
}

constexpr double t_3 = 3.18245;  // t(0.975, 3)

}  // namespace

TEST(NumpyRandom, HasTheNumbersOfDefaultRng) {
    NumpyRandom first(1), second(3735928559);
    EXPECT_DOUBLE_EQ(first.uniform(), 0.5118216247002567);
    EXPECT_DOUBLE_EQ(first.uniform(), 0.9504636963259353);
    EXPECT_DOUBLE_EQ(first.normal(), 0.33043707618338714);
    double sum = 0, most = 0;
    for (int i = 0; i < 100000; ++i) {  // of which some lie beyond the lowest layer's end
        const double x = second.normal();
        sum += x * x, most = std::max(most, std::abs(x));
    }
    EXPECT_NEAR(sum, 99685.53974723874, 1e-6);
    EXPECT_DOUBLE_EQ(most, 4.569799560873835);
}

TEST(TradeoffDraws, AMeanIsDrawnFromStudentsT) {
    const double half = t_3 * std::sqrt(0.001 / 3) / 2;
    const Made one{{point("a", 1, half, 10, 0, {0.98, 1.01, 0.99, 1.02})}};
    const std::vector<double> errors = one.draws(40000).errors[0];
    // 40000 draws give the ends to 3 % of the half-width; the exponential moves them by half^2 / 2 = 2 %.
    EXPECT_NEAR(quantile(errors, 0.025), 1 - half, 0.06 * half);
    EXPECT_NEAR(quantile(errors, 0.975), 1 + half, 0.06 * half);
    const std::vector<double> beyond_seeds = Made{{point("a", 1, 0.04, 10)}}.draws(40000).errors[0];
    EXPECT_NEAR(quantile(beyond_seeds, 0.975) - quantile(beyond_seeds, 0.025), 0.08, 0.003);
}

TEST(TradeoffDraws, PointsShareSeedsAndSlowFrames) {
    const std::vector<double> seeds = {0.9, 1.1, 1.0, 1.0};
    const Made two{{point("a", 1, 0.13, 10, 0.2, seeds), point("b", 1, 0.13, 20, 0.2, seeds)}};
    const Draws draws = two.draws();
    for (size_t i = 0; i < 100; ++i) EXPECT_NEAR(draws.costs[1][i], 2 * draws.costs[0][i], 1e-9);
    EXPECT_GT(quantile(draws.costs[0], 0.975), 10.05);
}

TEST(TradeoffCurves, InterpolateOnTheFrontAndNeverBeyondIt) {
    // error = 10 / cost, a straight line of slope -1; the fourth point is none of the front.
    const Curve curve =
        Made{{point("v", 10, 0, 1), point("v", 2.5, 0, 4), point("v", 0.625, 0, 16), point("v", 5, 0, 8)}}.curve();
    for (const double cost : {1.0, 2.0, 3.0, 8.0, 16.0}) {
        EXPECT_NEAR(*curve.error_at(cost).value, 10 / cost, 1e-12);
        EXPECT_NEAR(*curve.cost_to(10 / cost).value, cost, 1e-9);
    }
    EXPECT_FALSE(curve.error_at(0.9).value);
    EXPECT_EQ(curve.error_at(100).value, 0.625);  // it can be had, with time to spare
    EXPECT_FALSE(curve.cost_to(0.6).value);
    EXPECT_EQ(curve.cost_to(20).value, 1);
}

TEST(TradeoffCurves, AFrontThatChanceChoseIsNotBelieved) {
    Made near;
    for (size_t i = 0; i < 4; ++i) {
        std::vector<double> seeds(4, 1.05);
        seeds[i] = 0.85;
        near.points.push_back(point("v", 1 + 1e-3 * double(i), t_3 * 0.1 / 2, 10 - double(i), 0, seeds));
    }
    const Curve curve = near.curve(20000);
    const std::vector<double> alone = near.draws(20000).errors[0];
    const ReadOff past = curve.error_at(20), at = curve.error_at(10);
    EXPECT_EQ(past.value, 1);
    EXPECT_FALSE(past.low);
    EXPECT_LT(*at.low, quantile(alone, 0.025));                      // as the least of four falls
    EXPECT_NEAR(*past.high, quantile(alone, 1 - 0.025 / 4), 0.005);  // any of the four may be the least
}

TEST(TradeoffCurves, BeyondTheEndsOnlyAnUpperBoundIsKnown) {
    Made made;
    for (const double cost : {4.0, 8.0, 16.0}) {
        const double error = 10 / cost;
        made.points.push_back(
            point("v", error, 0.02 * error, cost, 0.05, {0.99 * error, 1.01 * error, 0.99 * error, 1.01 * error}));
    }
    for (MeasuredPoint& p : made.points) p.row.cost_low = 0.98 * p.cost(), p.row.cost_high = 1.02 * p.cost();
    const Curve curve = made.curve();
    const ReadOff before = curve.cost_to(5);  // of 2, by the law
    EXPECT_EQ(before.value, 4);
    EXPECT_FALSE(before.low);
    EXPECT_TRUE(*before.high > 4 && *before.high < 4.3);
    EXPECT_FALSE(curve.cost_to(2.48).low);  // draws may err less from the start on
    const ReadOff inside = curve.cost_to(2);
    EXPECT_TRUE(*inside.low > 4 && *inside.low < 5 && *inside.high > 5);
    EXPECT_FALSE(curve.error_at(20).low);
    EXPECT_LT(*curve.error_at(16).low, 0.625);  // of a point that ran
    const Curve seldom = Made{{point("v", 2, 0.01, 10), point("v", 1, 0.2, 20)}}.curve();
    EXPECT_FALSE(seldom.cost_to(1.05).high);  // as many draws do not reach it
    EXPECT_TRUE(seldom.cost_to(1.05).share > 0.5 && seldom.cost_to(1.05).share < 0.9);
}

TEST(TradeoffFits, FindALawOrSayWhyNot) {
    const std::vector<double> costs = {2, 4, 8, 16, 32, 64};
    const auto fit = [&](auto law, double deviation = 0.01) {
        std::vector<double> errors;
        for (size_t i = 0; i < costs.size(); ++i) errors.push_back(law(costs[i], i));
        return fit_law(costs, errors, std::vector<double>(6, deviation), std::vector<double>(6, 0.001));
    };
    const auto law = [](double c, size_t) { return 0.2 + 3 * std::pow(c, -1.25); };
    const Fit found = fit(law);
    EXPECT_EQ(found.status, "fitted");
    // The exponents' grid has steps of 1.8 %.
    EXPECT_NEAR(*found.floor, 0.2, 0.004);
    EXPECT_NEAR(*found.b, 1.25, 0.02);
    EXPECT_NEAR(*found.a, 3, 0.1);
    EXPECT_TRUE(*found.floor_low > 0 && *found.floor_low < 0.2 && *found.floor_high > 0.2 && *found.floor_high < 0.25);
    EXPECT_EQ(fit([](double c, size_t) { return 3 / c; }).floor_low, 0);
    EXPECT_EQ(fit([](double c, size_t) { return 2 / std::sqrt(c) - 0.1; }).floor, 0);
    const Fit wide = fit(law, 0.05),
              bent = fit([&](double c, size_t i) { return law(c, i) * (i % 2 ? 1.1 : 1); }, 0.001);
    EXPECT_GT(*wide.floor_high - *wide.floor_low, 3 * (*found.floor_high - *found.floor_low));
    EXPECT_GT(*bent.misfit, 10);
    EXPECT_NE(fit([](double, size_t i) { return i % 2 ? 1.01 : 1; }).status.find("does not surely fall"),
              std::string::npos);
    const Fit step = fit([](double, size_t i) { return i == 0 ? 1 : 0.2; });
    EXPECT_NE(step.status.find("one step"), std::string::npos);
    EXPECT_TRUE(*step.floor_low < 0.2 && *step.floor_high > 0.2 && !step.b_high);
}

TEST(TradeoffFits, AxesDifferInOneNumberAlone) {
    std::vector<MeasuredPoint> points;
    std::map<PointName, nlohmann::json> parameters;
    const auto add = [&](const std::string& name, int rays, int wide) {
        points.push_back(point("v", 1, 0, rays));
        points.back().row.point = name;
        parameters[points.back().name()] = {{"rays", std::to_string(rays)}, {"wide", wide}, {"mode", "a"}};
    };
    for (const int rays : {1, 2, 4}) add("rays=" + std::to_string(rays) + " wide=1", rays, 1);
    for (const int rays : {8, 4, 2, 1}) add("rays=" + std::to_string(rays) + " wide=0", rays, 0);
    add("default", 16, 0);
    const std::vector<QualityAxis> axes = quality_axes(points, parameters);
    ASSERT_EQ(axes.size(), 1);
    EXPECT_EQ(axes[0].parameter + ", " + axes[0].fixed, "rays, wide=0");
    ASSERT_EQ(axes[0].points.size(), 5);
    EXPECT_EQ(axes[0].points[0]->row.point, "rays=1 wide=0");
    EXPECT_EQ(axes[0].points[4]->row.point, "default");
}

TEST(Markdown, TextsOfOthersStayTexts) {
    EXPECT_EQ(markdown_text(" a_b|c <i> &lt; [x](y) _z_ \\| $1 "), R"(a_b\|c &lt;i> &amp;lt; [x\](y) \_z\_ \\\| \$1)");
    EXPECT_EQ(markdown_text("amd_sssr dda.thickness=0.25"), "amd_sssr dda.thickness=0.25");
    EXPECT_EQ(markdown_code("a``b`"), "``` a``b` ```");
    EXPECT_EQ(markdown_table({"a", "b"}, {{"1", "x|y"}}), "| a | b |\n|---|---|\n| 1 | x\\|y |\n\n");
}
