#include "experiments/evaluation/time_effects.h"

#include "core/error.h"
#include "core/files.h"
#include "experiments/tables/csv.h"
#include "metrics/median_interval.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace {

using StageKey = std::tuple<std::string, std::string, std::string, std::string>;  // shot, stage, variant, point
struct Timed {
    std::string clock;
    std::map<unsigned, double> of_round;  ///< ms; a stage may run several times in a frame
};

}  // namespace

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
            const MedianInterval m = median_interval(ratios);
            effects.push_back({shot, variant, point, c.against, c.baseline->variant, c.baseline->point, stage,
                               timed.clock, ratios.size(), m.median, m.low, m.high});
        }
    return effects;
}
