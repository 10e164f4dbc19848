#include "experiments/results/tradeoff/other_costs.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>

namespace {

const std::string total = "total";

template <class Row>
std::vector<std::string> distinct_names(const std::vector<Row>& rows, std::string Row::*name) {
    std::set<std::string> names;
    for (const Row& row : rows) names.insert(row.*name);
    return {names.begin(), names.end()};
}

}  // namespace

CostKind cost_kind(const StudyResults& tables, const std::string& cost) {
    if (cost.empty()) return CostKind::timed;
    std::vector<std::string> known = distinct_names(tables.costs, &CostRow::quantity);
    if (std::ranges::count(known, cost)) return CostKind::counted;
    const std::vector<std::string> chips = distinct_names(tables.estimates, &EstimateRow::chip);
    if (std::ranges::count(chips, cost)) return CostKind::estimated;
    known.insert(known.end(), chips.begin(), chips.end());
    fail("costs.csv has no '", shortened(cost), "', and estimates.csv no such chip",
         known.empty() ? "" : suggestion(cost, known));
}

std::map<PointName, OtherCost> other_costs(const StudyResults& tables, const std::string& shot,
                                           const std::string& cost) {
    std::map<PointName, OtherCost> found;
    if (cost_kind(tables, cost) == CostKind::estimated) {
        for (const EstimateRow& e : tables.estimates) {
            if (e.shot != shot || e.chip != cost || e.stage != total || !e.microseconds) continue;
            const double low = e.low.value_or(*e.microseconds), high = e.high.value_or(*e.microseconds);
            found[{e.technique, e.point}] = {.value = *e.microseconds,
                                             .low = low,
                                             .high = high,
                                             .fits_from = high * model_range.high,
                                             .may_fit_from = low * model_range.low,
                                             .decides_from = model_decides_from};
        }
        return found;
    }
    std::map<PointName, double> sums, totals;  // a stage of that name has the sum of all
    for (const CostRow& c : tables.costs)
        if (c.shot == shot && c.quantity == cost)
            (c.stage == total ? totals : sums)[{c.technique, c.point}] += double(c.value);
    for (const auto& [point, sum] : totals) sums[point] = sum;
    const PointSet without_seeds = points_without_seeds(tables.manifest);
    for (const auto& [point, sum] : sums) {
        const double decides_from = without_seeds.contains(point) ? 1 : counts_decide_from(cost);
        found[point] = {sum, sum, sum, sum * decides_from, sum / decides_from, decides_from};
    }
    return found;
}

std::string cost_verdict(const OtherCost& a, const OtherCost& b) {
    if (a == b) return verdict::equal;
    const double decides_from = std::max(a.decides_from, b.decides_from);
    if (a.high < b.low && a.value * decides_from <= b.value) return verdict::less;
    if (b.high < a.low && b.value * decides_from <= a.value) return verdict::more;
    return verdict::undecided;
}

std::vector<RefusedEstimate> refused_estimates(const StudyResults& tables, const std::set<std::string>& shots,
                                               const std::string& cost) {
    std::vector<RefusedEstimate> found;
    for (const EstimateRow& e : tables.estimates) {
        if (e.chip != cost || e.stage != total || e.refusal.empty() || !shots.contains(e.shot)) continue;
        const PointName point(e.technique, e.point);
        auto same = std::ranges::find_if(
            found, [&](const RefusedEstimate& other) { return other.point == point && other.refusal == e.refusal; });
        if (same == found.end()) same = found.insert(same, {.point = point, .refusal = e.refusal, .shots = {}});
        same->shots.push_back(e.shot);
    }
    return found;
}
