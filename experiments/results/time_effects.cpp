#include "experiments/results/time_effects.h"

#include "core/error.h"
#include "core/files.h"
#include "experiments/results/csv.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace {

/// By how much more than independent signs those of d - median scatter over n of them.
double sign_variance_factor(std::span<const double> values, double median) {
    const size_t n = values.size();
    const auto sign = [&](size_t i) { return double(values[i] > median) - double(values[i] < median); };
    double factor = 1;
    for (size_t lag = 1; lag < n / 2; ++lag) {
        double sum = 0;
        for (size_t i = lag; i < n; ++i) sum += sign(i) * sign(i - lag);
        const double correlation = (sum + 1) / double(n);  // signs about their own median are anticorrelated by 1 / n
        if (correlation <= 0) break;
        factor += 2 * correlation;
    }
    return std::max(factor, 2.0);
}

using StageKey = std::tuple<std::string, std::string, std::string, std::string>;  // shot, stage, variant, point
struct Timed {
    std::string clock;
    std::map<unsigned, double> of_round;  ///< ms; a stage may run several times in a frame
};

}  // namespace

PairedMedian paired_median(std::span<const double> in_order_of_time) {
    if (in_order_of_time.empty()) fail("no values to take a median of");
    std::vector<double> sorted(in_order_of_time.begin(), in_order_of_time.end());
    std::ranges::sort(sorted);
    const size_t n = sorted.size();
    PairedMedian m{.median = n % 2 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2])};
    const double half_width = 1.96 * std::sqrt(sign_variance_factor(in_order_of_time, m.median) * double(n)) / 2;
    const double rank = std::max(0.0, std::floor(double(n) / 2 - half_width));
    m.low = sorted[size_t(rank)], m.high = sorted[n - 1 - size_t(rank)];
    return m;
}

std::vector<TimeEffectRow> time_effects(std::span<const TimeRow> times, const std::vector<VariantConfig>& variants) {
    std::map<StageKey, Timed> table;
    for (const TimeRow& t : times) {
        Timed& timed = table[{t.shot, t.stage, t.variant, t.point}];
        timed.clock = t.clock, timed.of_round[t.frame] += t.milliseconds;
    }
    std::vector<TimeEffectRow> effects;
    for (const PointComparison& c : comparisons_of(variants))
        for (const auto& [key, timed] : table) {
            const auto& [shot, stage, variant, point] = key;
            if (variant != c.point->variant || point != c.point->point) continue;
            const auto other = table.find({shot, stage, c.baseline->variant, c.baseline->point});
            if (other == table.end()) continue;
            std::vector<double> ratios;
            for (const auto& [round, milliseconds] : timed.of_round)
                if (const auto base = other->second.of_round.find(round);
                    base != other->second.of_round.end() && base->second > 0 && milliseconds > 0)
                    ratios.push_back(milliseconds / base->second);
            if (ratios.empty()) continue;
            const PairedMedian m = paired_median(ratios);
            effects.push_back({shot, variant, point, c.against, c.baseline->variant, c.baseline->point, stage,
                               timed.clock, ratios.size(), m.median, m.low, m.high});
        }
    return effects;
}
