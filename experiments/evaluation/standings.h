#pragma once
#include "experiments/evaluation/effects/effects.h"
#include "experiments/evaluation/summary.h"

#include <span>

/// MetricSummary::standing: the one decision of which point of a shot is the best by an error. Report, tables, figures
/// and answers print it.
namespace standing {

inline constexpr const char* best = "best";      ///< significantly better than all others that are ranked
inline constexpr const char* tied = "tied";      ///< the best measured, and those not distinguishable from it
inline constexpr const char* behind = "behind";  ///< significantly worse than the best measured

}  // namespace standing

/// Decides `standing` of all rows that stand for their shot (represents_shot) and are ranked (holds_all_noise), for
/// each shot, target, metric and mask by itself; fewer than two ranked points have none. All others keep it empty: a
/// single seed's error is measured, not ranked. Points in `without_part` take none, as those that use scene data.
///
/// Each point is compared with the best measured one, by the ratio of their errors paired by seed and reference
/// (`paired`, jackknifed_ratio()) where that holds all noise, else by the intervals of both. p-values are adjusted for
/// the points of the shot (Holm 1979) and judged at 0.05, so that the point which is truly best is among `best` and
/// `tied` in 95 % of shots or more: the confidence set of Hsu 1984, "Constrained Simultaneous Confidence Intervals for
/// Multiple Comparisons with the Best", by adjusted p-values. Simulated in tests/experiments/evaluation.
void set_standings(std::span<MetricSummary> errors, const PairedErrors& paired = {}, const PointSet& without_part = {});

/// What a front of errors may be against: the median time of a frame, or counts of the last frame (pass_cost.h).
namespace front {
inline constexpr const char* time = "time";
inline constexpr const char* fetches = "fetches";
inline constexpr const char* bytes = "bytes";  ///< read and written
inline constexpr const char* operations = "operations";
}  // namespace front

/// Sets `fronts` of each row to the costs, with blanks between, against which it is on the front of its shot, by
/// medians and means alone: of the points with a standing none other beats it in both. A hint of where to look: `ssrlab
/// tradeoff` says which of them are certain.
void set_fronts(std::span<MetricSummary> errors, std::span<const TimeSummary> times,
                std::span<const CostRow> costs = {});
bool is_on_front(const MetricSummary& error, const std::string& cost);

/// Two-sided p of "both are equal" by their 95 % intervals, of which the ends that face each other count; the
/// half-widths are Student's of the lesser number of seeds, or a normal's of points that do not depend on seeds.
double p_by_intervals(const MetricSummary& a, const MetricSummary& b);

/// The adjusted p of a point and the best measured one of its shot, as their standing has it (MetricSummary::p_best).
/// Refers to `errors`, which have standings and must outlive it.
DecidedP decided_by_standings(std::span<const MetricSummary> errors);
