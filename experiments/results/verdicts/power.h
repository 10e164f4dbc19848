#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/summary.h"

#include <optional>
#include <span>
#include <vector>

// Which differences a study can see: the power of its comparisons, beside their verdicts.

/// Probability with which a study must detect a difference that it "can see": 8 of 10 such studies.
inline constexpr double wanted_power = 0.8;

/// Power of Student's test at the two-sided `level` in (0, 1), for a true difference of `effects` standard errors. It
/// is the probability that a noncentral t of `degrees` of freedom lies beyond the central quantile. `degrees` 0: the
/// standard error is known, and the test is normal.
double power_of_test(double effects, double degrees, double level);

/// The least true difference, in standard errors, that is found with `power`, in (level, 1).
double effects_seen(double degrees, double level, double power = wanted_power);

/// The ratio of two errors, as its interval states it.
struct ComparedRatio {
    double low = 1, high = 1;  ///< its 95 % interval, above 0
    double degrees = 0;        ///< degrees of freedom of the interval's Student's t; 0: normal

    /// Standard error of the ratio's logarithm.
    double standard_error() const;
};

/// The least difference that a study of this kind detects with wanted_power: how much one error must exceed another, as
/// a share of it. It is exp(effects_seen() s) - 1 with the standard error s. The test is the strictest of `comparisons`
/// that are adjusted together (Bonferroni).
struct VisibleDifference {
    double typical = 0;    ///< share of the error: the median over the compared points
    double largest = 0;    ///< that of the point with most scatter
    PointName of_largest;  ///< that point's name
    size_t comparisons = 0;
};

/// The number of pairs that remain to be distinguished, at least 1. Each shot counts C(r, 2) pairs of the r points that
/// are not certainly behind by one error (adjusted_for_choice()).
size_t comparisons_left(std::span<const MetricSummary> errors, const std::string& target, const std::string& metric,
                        const std::string& mask);

/// The visible difference in one shot. `points`: ranked by one error (target, metric, mask); those paired with the best
/// count (MetricSummary::over_best_low). None without such a pair.
std::optional<VisibleDifference> visible_in_shot(std::span<const MetricSummary* const> points, size_t comparisons);

/// The visible difference over scenes like the study's. `rows`: of one error, ranked. None below least_scenes.
std::optional<VisibleDifference> visible_over_scenes(std::span<const OverScenesRow* const> rows);

/// The number of scenes like these that show that the typical point errs worth_deciding more than the best
/// (scenes_needed()).
std::optional<double> scenes_needed_for(std::span<const OverScenesRow* const> rows);
