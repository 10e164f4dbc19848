#pragma once
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/summary.h"

#include <span>

/// MetricSummary::standing: which point of a shot is the best by an error. Decided here once; report, tables, figures
/// and answers print it.
namespace standing {

inline constexpr const char* best = "best";  ///< significantly better than all other ranked points
/// The best measured if another is not behind, and points undecided against it.
inline constexpr const char* tied = "tied";
inline constexpr const char* equivalent = "equivalent";  ///< not behind, and certainly within the margin of the best
inline constexpr const char* behind = "behind";          ///< significantly worse than the best measured

/// The standing of a point other than the best measured one, by its adjusted p-values.
inline const char* of(double p_best, double p_equivalent) {
    return p_best < significance ? behind : p_equivalent < significance ? equivalent : tied;
}

}  // namespace standing

/// Decides `standing` among the points of each shot, of all rows that represent their shot (represents_shot) and are
/// ranked (MetricSummary::ranked). It stays empty for all others and where fewer than two points are ranked: a single
/// seed's error is measured, not ranked. Points in `without_part`, which use scene data, take no part.
///
/// Each point is compared with the best measured one by the ratio of their errors, paired by seed and reference
/// (`paired`, jackknifed_ratio()) if its interval includes all noise, else by both intervals. All shots of an error
/// (target, metric, mask) are a family, adjusted_for_choice(): in at most 5 % of studies a truly best point is called
/// behind. "Within `margin` of the best" is the opposite claim, of two one-sided tests, adjusted for all points and
/// shots of the error (Holm 1979).
void set_standings(std::span<MetricSummary> errors, const PairedErrors& paired = {}, const PointSet& without_part = {},
                   double margin = PrimaryComparisons().margin);

/// Gives each pair one verdict. Where an effect of the study compares a point with the best of its shot, raises the
/// point's p to the effect's p and decides the standing again.
void match_effects(std::span<MetricSummary> errors, std::span<const EffectRow> effects);

/// The costs that a front of errors can have: the median time of a frame, or counts of the last frame (pass_cost.h).
namespace front {
inline constexpr const char* time = "time";
inline constexpr const char* fetches = "fetches";
inline constexpr const char* bytes = "bytes";  ///< read and written
inline constexpr const char* operations = "operations";
}  // namespace front

/// Sets `fronts` of each row: the costs and chips (by estimated time), separated by blanks, for which the point is on
/// its shot's front. By medians and means alone, among points with a standing: no other beats it in both. This is a
/// hint; `ssrlab tradeoff` says which are certain.
void set_fronts(std::span<MetricSummary> errors, std::span<const TimeSummary> times,
                std::span<const CostRow> counts = {}, std::span<const EstimateRow> estimates = {});
bool is_on_front(const MetricSummary& error, const std::string& cost);

/// Compares two errors by the ends of their 95 % intervals that face each other. Half-widths are Student's of the
/// smaller number of seeds, or normal for points that do not depend on seeds. Returns the two-sided p of "both are
/// equal", and the p of "a is not within `margin` (a share of b's error) of b" (p_beyond_limits()).
PairP p_by_intervals(const MetricSummary& a, const MetricSummary& b, double margin);

/// The adjusted p of a point and the best measured one of its shot, as in their standing (MetricSummary::p_best).
/// Refers to `errors`, which must have standings and outlive the result.
DecidedPair decided_by_standings(std::span<const MetricSummary> errors);
