#pragma once
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/summary.h"

#include <span>

/// MetricSummary::standing: the one decision of which point of a shot is the best by an error. Report, tables, figures
/// and answers print it.
namespace standing {

inline constexpr const char* best = "best";  ///< significantly better than all others that are ranked
/// The best measured where another is not behind, and those of which nothing is decided.
inline constexpr const char* tied = "tied";
inline constexpr const char* equivalent = "equivalent";  ///< not behind, and certainly within the margin of the best
inline constexpr const char* behind = "behind";          ///< significantly worse than the best measured

/// Of a point that is not the best measured one, by its adjusted p-values.
inline const char* of(double p_best, double p_equivalent) {
    return p_best < significance ? behind : p_equivalent < significance ? equivalent : tied;
}

}  // namespace standing

/// Decides `standing` of all rows that stand for their shot (represents_shot) and are ranked (MetricSummary::ranked),
/// among the points of each shot; fewer than two ranked points have none. All others keep it empty: a single seed's
/// error is measured, not ranked. Points in `without_part` take none, as those that use scene data.
///
/// Each point is compared with the best measured one, by the ratio of their errors paired by seed and reference
/// (`paired`, jackknifed_ratio()) where that holds all noise, else by the intervals of both. All shots of an error
/// (target, metric, mask) are a family, adjusted_for_choice(): in at most 5 % of studies a point that is truly best in
/// its shot is called behind. "Within `margin` of the best" is the opposite claim, of two one-sided tests, adjusted for
/// all points and shots of the error (Holm 1979).
void set_standings(std::span<MetricSummary> errors, const PairedErrors& paired = {}, const PointSet& without_part = {},
                   double margin = PrimaryComparisons().margin);

/// A pair has one verdict: raises the p of points that an effect of the study compares with the best of their shot to
/// that effect's, whose family is another, and decides their standing anew.
void match_effects(std::span<MetricSummary> errors, std::span<const EffectRow> effects);

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

/// By the 95 % intervals of two errors, of which the ends that face each other count; the half-widths are Student's of
/// the lesser number of seeds, or a normal's of points that do not depend on seeds. Two-sided p of "both are equal",
/// and the p of "a is not within `margin` of b", a share of b's error (p_beyond_limits()).
PairP p_by_intervals(const MetricSummary& a, const MetricSummary& b, double margin);

/// The adjusted p of a point and the best measured one of its shot, as their standing has it (MetricSummary::p_best).
/// Refers to `errors`, which have standings and must outlive it.
DecidedPair decided_by_standings(std::span<const MetricSummary> errors);
