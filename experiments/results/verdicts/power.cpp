#include "experiments/results/verdicts/power.h"

#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

double normal_share_below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

double test_quantile(double share, double degrees) {
    return degrees > 0 ? student_t_quantile(share, degrees) : normal_quantile(share);
}

double adjusted_level(size_t comparisons) { return significance / double(std::max<size_t>(comparisons, 1)); }

double middle_of(std::vector<double> values) {
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

struct NamedRatio {
    PointName name;
    ComparedRatio ratio;
};

std::optional<VisibleDifference> visible_of_pairs(const std::vector<NamedRatio>& pairs, size_t comparisons) {
    if (pairs.empty()) return {};
    // By degrees of freedom and level, of which a study has few, whatever the number of its shots.
    thread_local std::map<std::pair<double, double>, double> effects;
    std::vector<double> seen;
    VisibleDifference visible{.comparisons = comparisons};
    const double level = adjusted_level(comparisons);
    for (const NamedRatio& pair : pairs) {
        const auto [found, is_new] = effects.try_emplace({pair.ratio.degrees, level});
        if (is_new) found->second = effects_seen(pair.ratio.degrees, level);
        seen.push_back(std::expm1(found->second * pair.ratio.standard_error()));
        if (seen.back() >= visible.largest) visible.largest = seen.back(), visible.of_largest = pair.name;
    }
    visible.typical = middle_of(seen);
    return visible;
}

bool has_ratio_interval(const std::optional<double>& low, const std::optional<double>& high) {
    return low && high && *low > 0 && std::isfinite(*high) && *high >= *low;
}

/// The pairs with the first rank. That compares with none, and has no interval. Intervals are of the scenes' own
/// scatter, moderated where three points or more tell it together (PooledScatter).
std::vector<NamedRatio> pairs_over_scenes(std::span<const OverScenesRow* const> rows) {
    std::vector<NamedRatio> pairs;
    for (const OverScenesRow* row : rows) {
        const double scenes = double(row->scenes), degrees = rows.size() > 2 ? scenes - 1 + pooled_degrees : scenes - 2;
        if (row->scenes >= least_scenes && has_ratio_interval(row->over_best_low, row->over_best_high))
            pairs.push_back({{row->technique, row->point}, {*row->over_best_low, *row->over_best_high, degrees}});
    }
    return pairs;
}

size_t count_of_pairs(size_t points) { return points * (points - std::min<size_t>(points, 1)) / 2; }

}  // namespace

double power_of_test(double effects, double degrees, double level) {
    const double limit = test_quantile(1 - level / 2, degrees);
    if (effects > 20 * limit) return 1;  // beyond doubt, and beyond the reach of the series
    if (!(degrees > 0)) return normal_share_below(effects - limit) + normal_share_below(-effects - limit);
    return 1 - noncentral_t_cdf(limit, degrees, effects) + noncentral_t_cdf(-limit, degrees, effects);
}

double effects_seen(double degrees, double level, double power) {
    double low = 0, high = 1;
    while (power_of_test(high, degrees, level) < power) low = high, high *= 2;
    while (high - low > 1e-4 * high) {
        const double middle = 0.5 * (low + high);
        (power_of_test(middle, degrees, level) < power ? low : high) = middle;
    }
    return high;
}

double ComparedRatio::standard_error() const {
    return (std::log(high) - std::log(low)) / 2 / test_quantile(0.975, degrees);
}

size_t comparisons_left(std::span<const MetricSummary> errors, const std::string& target, const std::string& metric,
                        const std::string& mask) {
    std::map<std::string, size_t> left;
    for (const MetricSummary& e : errors)
        if (!e.standing.empty() && e.standing != standing::behind && e.target == target && e.metric == metric &&
            e.mask == mask)
            ++left[e.shot];
    size_t pairs = 0;
    for (const auto& [shot, points] : left) pairs += count_of_pairs(points);
    return std::max<size_t>(pairs, 1);
}

std::optional<VisibleDifference> visible_in_shot(std::span<const MetricSummary* const> points, size_t comparisons) {
    // Of a pair the degrees of the seeds alone are counted, as Satterthwaite's are not kept. The noise of the reference
    // adds more, so that what is said to be seen is not too little.
    std::vector<NamedRatio> pairs;
    for (const MetricSummary* e : points)
        if (has_ratio_interval(e->over_best_low, e->over_best_high))
            pairs.push_back(
                {{e->technique, e->point}, {*e->over_best_low, *e->over_best_high, double(e->seed_degrees())}});
    return visible_of_pairs(pairs, comparisons);
}

std::optional<VisibleDifference> visible_over_scenes(std::span<const OverScenesRow* const> rows) {
    const auto left = size_t(std::ranges::count_if(rows, [](auto* row) { return row->standing != standing::behind; }));
    return visible_of_pairs(pairs_over_scenes(rows), std::max<size_t>(count_of_pairs(left), 1));
}

std::optional<double> scenes_needed_for(std::span<const OverScenesRow* const> rows) {
    std::vector<double> deviations;
    for (const NamedRatio& pair : pairs_over_scenes(rows))
        deviations.push_back(pair.ratio.standard_error() * std::sqrt(double(rows.front()->scenes)));
    if (deviations.empty()) return {};
    return scenes_needed(middle_of(deviations));
}
