#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/summary.h"

#include <optional>
#include <span>
#include <vector>

// Which differences a study can see: the power of its comparisons, beside their verdicts.

/// How often a difference is to be seen that the study is said to see: in 8 of 10 such studies.
inline constexpr double wanted_power = 0.8;

/// Probability that Student's test at the two-sided `level` in (0, 1) finds a true difference of `effects` standard
/// errors: that a noncentral t of `degrees` of freedom lies beyond the central one's quantile. `degrees` 0: the
/// standard error is known, and the test is a normal's.
double power_of_test(double effects, double degrees, double level);

/// The least true difference, in standard errors, that is found with so much power, in (level, 1).
double effects_seen(double degrees, double level, double power = wanted_power);

/// One error over another, as intervals tell it.
struct ComparedRatio {
    double low = 1, high = 1;  ///< its 95 % interval, above 0
    double degrees = 0;        ///< of freedom of the Student's t that the interval is of; 0: a normal's

    /// Of the ratio's logarithm.
    double standard_error() const;
};

/// What a study of this kind can see of one error: by how much it must exceed another, as a share of that, to be seen
/// with wanted_power, exp(effects_seen() s) - 1 with s the standard error. The test is the strictest of `comparisons`
/// that are adjusted together (Bonferroni).
struct VisibleDifference {
    double typical = 0;    ///< share of the error: the median over the compared points
    double largest = 0;    ///< that of the point which scatters most ...
    PointName of_largest;  ///< ... and its name
    size_t comparisons = 0;
};

/// The pairs that are still to be distinguished where all that is certainly behind has left: of each shot's points by
/// one error, C(r, 2) of those that are not, in all shots together (adjusted_for_choice()). At least 1.
size_t comparisons_left(std::span<const MetricSummary> errors, const std::string& target, const std::string& metric,
                        const std::string& mask);

/// Of one shot: `points` are its ranked ones by one error (target, metric, mask), of which those that were paired with
/// the best count (MetricSummary::over_best_low). None where there is no such pair.
std::optional<VisibleDifference> visible_in_shot(std::span<const MetricSummary* const> points, size_t comparisons);

/// Over scenes like the study's: `rows` are those of one error that are ranked. None below least_scenes.
std::optional<VisibleDifference> visible_over_scenes(std::span<const OverScenesRow* const> rows);

/// How many scenes like these show that the typical point errs worth_deciding more than the best (scenes_needed()).
std::optional<double> scenes_needed_for(std::span<const OverScenesRow* const> rows);
