#include "experiments/results/verdicts/effects/time_effects.h"

#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/interval.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace {

using StageKey = std::tuple<std::string, std::string, std::string, std::string>;  // shot, stage, technique, point
struct Timed {
    std::string clock;
    std::map<unsigned, double> of_round;  ///< ms; a stage may run several times in a frame
};

}  // namespace

std::vector<TimeEffectRow> time_effects(std::span<const TimeRow> times, const std::vector<ComparedPoint>& compared) {
    std::map<StageKey, Timed> table;
    for (const TimeRow& t : times) {
        Timed& timed = table[{t.shot, t.stage, t.technique, t.point}];
        timed.clock = t.clock, timed.of_round[t.frame] += t.milliseconds;
    }
    std::vector<TimeEffectRow> effects;
    for (const PointComparison& c : comparisons_of(compared))
        for (const auto& [key, timed] : table) {
            const auto& [shot, stage, technique, point] = key;
            if (technique != c.point->technique || point != c.point->point) continue;
            const auto other = table.find({shot, stage, c.baseline->technique, c.baseline->point});
            if (other == table.end()) continue;
            std::vector<double> ratios;
            for (const auto& [round, milliseconds] : timed.of_round)
                if (const auto base = other->second.of_round.find(round);
                    base != other->second.of_round.end() && base->second > 0 && milliseconds > 0)
                    ratios.push_back(milliseconds / base->second);
            if (ratios.empty()) continue;
            const Estimate m = median_interval(ratios);
            effects.push_back({shot, technique, point, c.against, c.baseline->technique, c.baseline->point, stage,
                               timed.clock, ratios.size(), m.value, m.low, m.high});
        }
    return effects;
}

double TimeRatio::p_value() const {
    if (!(half_width > 0)) return log_ratio == 0 ? 1 : 0;
    const double t = std::abs(log_ratio) / half_width * normal_quantile(0.975);
    return 2 * student_t_cdf(-t, double(std::max<size_t>(degrees, 1)));
}

std::pair<double, double> TimeRatio::interval(double level) const {
    const double quantile = student_t_quantile(1 - level / 2, double(std::max<size_t>(degrees, 1)));
    const double half = half_width * quantile / normal_quantile(0.975);
    return {std::exp(log_ratio - half), std::exp(log_ratio + half)};
}

TimeRatio time_ratio(const Estimate& rounds, double aa_floor, size_t aa_pairs) {
    return {.log_ratio = std::log(rounds.value),
            .half_width = std::hypot(std::log(rounds.high / rounds.low) / 2, std::log1p(aa_floor)),
            .degrees = aa_pairs};
}

void set_time_verdicts(std::span<TimeEffectRow> effects, const nlohmann::json& manifest) {
    std::vector<TimeEffectRow*> family;
    std::vector<TimeRatio> ratios;
    std::vector<double> p;
    for (TimeEffectRow& e : effects) {
        e.p = e.p_holm = e.low_holm = e.high_holm = std::nullopt, e.verdict.clear();
        const std::optional<double> floor = aa_floor(manifest, e.shot);
        if (e.stage != "total" || !floor || !(e.low > 0)) continue;
        family.push_back(&e);
        ratios.push_back(time_ratio({e.ratio, e.low, e.high}, *floor, aa_pair_count(manifest, e.shot)));
        p.push_back(ratios.back().p_value());
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (size_t i = 0; i < family.size(); ++i) {
        TimeEffectRow& e = *family[i];
        e.p = p[i], e.p_holm = adjusted[i];
        const double factor = adjustment_factor(p[i], adjusted[i], family.size());
        set_adjusted_interval(e, ratios[i].interval(significance / factor));
        e.verdict = verdict_of({adjusted[i]}, e.ratio);
    }
}
