#pragma once
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/effects/scatter_over_scenes.h"
#include "experiments/results/verdicts/summary.h"

#include <nlohmann/json.hpp>

// Statistics over scenes, which are the sample. Shots of one scene, and scenes of one asset, are averaged first.

/// A value of one shot.
struct ShotValue {
    std::string asset;
    double value = 0;
};

/// A mean with its 95 % interval over scenes like these: Student's t, with a variance moderated by PooledScatter.
struct MeanOverScenes {
    double value = 0;
    std::optional<double> low, high;  ///< none below least_scenes
    std::optional<double> p;          ///< two-sided, of "the mean is 0"; also none if all scenes agree
    size_t scenes = 0;
    double standard_error = 0, degrees = 0;  ///< of `value`; 0 below least_scenes
};
/// Fails with Error where there is no value.
MeanOverScenes mean_over_scenes(std::span<const ShotValue> values);

/// The 95 % interval of the mean by resampling scenes (BCa; Efron 1987, "Better Bootstrap Confidence Intervals"). For
/// comparison only: with few scenes it is too narrow. Deterministic for each `seed`. None below least_scenes, or if all
/// values are equal.
std::optional<std::pair<double, double>> bootstrap_over_scenes(std::span<const double> values, unsigned seed = 1);

/// One shot's errors of all compared points, with and without the reference's noise.
struct ShotErrors {
    std::string asset;
    std::optional<Extrapolated> divisor;  ///< the baseline's; none: no measure, and the shot counts for no point
    std::map<PointName, Extrapolated> errors;
};

/// The number of scenes like these, at least least_scenes, that detect a difference of `worth_deciding` in the mean of
/// logarithms of ratios, with 80 % power at 5 % significance (two-sided, Student's t of n - 2 degrees). `deviation`:
/// standard deviation over scenes.
double scenes_needed(double deviation);
inline constexpr double worth_deciding = 0.1;  ///< 10 % more error

/// Statistics over scenes of one point's errors.
struct OverScenes {
    std::string technique, point;
    size_t scenes = 0, shots = 0;                     ///< with errors of point and baseline above 0
    double ratio = 1;                                 ///< geometric mean over scenes of error / baseline's error
    std::optional<double> low, high;                  ///< of MeanOverScenes, by all laws
    std::optional<double> rank, rank_low, rank_high;  ///< 1: the least error; ends: with any one scene left out
    std::optional<double> over_best, over_best_low, over_best_high;  ///< error / error of the first rank
    std::optional<double> p_holm;        ///< of "over_best is 1", adjusted_for_choice() among all compared here
    std::optional<double> p_equivalent;  ///< of "over_best is not within the margin", adjusted (Holm)
    std::optional<double> chance_first, chance_near;  ///< ChanceOverScenes among ranked points
    std::string standing;                             ///< see standings.h; for points ranked over least_scenes or more
    /// Scenes that would distinguish the point from the first rank if one errs worth_deciding more. Ends from the 95 %
    /// interval of the deviation (normal logarithms). None below least_scenes.
    std::optional<double> scenes_needed, scenes_needed_low, scenes_needed_high;
    ScenesByLaw logarithms = {};  ///< logarithms of the ratio
};

/// Compares points over scenes, by ascending rank, unranked points last. A point is ranked if it lacks at most the
/// share `lacking` of the shots that count; ranks are over the shots that all ranked points have. The first rank was
/// chosen from the scenes that it is compared over, so `standing` says which points may be the best (the confidence set
/// of set_standings()), not how far the first is ahead. `margin`: see PrimaryComparisons.
std::vector<OverScenes> compare_over_scenes(std::span<const ShotErrors> shots, double lacking = 0,
                                            double margin = PrimaryComparisons().margin);

/// Largest share of shots without an error above 0 that a ranked point may have.
inline constexpr double most_lacking = 0.1;

/// The median over scenes with an interval of at least 95 % from order statistics, exact for any distribution; no
/// interval below six scenes.
struct MedianOverScenes {
    double value = 0;
    std::optional<double> low, high;
};
/// Fails with Error where there is no value.
MedianOverScenes median_over_scenes(std::vector<double> values);
MedianOverScenes median_over_scenes(const ScenesByLaw& values);

/// The point that errors are multiples of: `none` (no screen-space reflections) if the study has it, else its first
/// baseline, else its first point. Fails with Error if the manifest has no techniques.
PointName baseline_over_scenes(const nlohmann::json& manifest);

/// The baseline's error in a shot, as a divisor. None where it is indistinguishable from 0, less than twice the score
/// of the reference's noise, or below a millionth of the shot's largest error (rounding). `errors`: of that shot, by
/// one target, metric and mask.
std::optional<Extrapolated> divisor_of(std::span<const MetricSummary* const> errors, const PointName& baseline);

/// A row of over_scenes.csv.
struct OverScenesRow : OverScenes {
    std::string target, metric, mask, baseline_technique, baseline_point;

    COLUMNS(OverScenesRow, target, metric, mask, technique, point, baseline_technique, baseline_point, scenes, shots,
            ratio, low, high, rank, rank_low, rank_high, over_best, over_best_low, over_best_high, p_holm, p_equivalent,
            chance_first, chance_near, standing)
};

/// Errors over scenes, for every error (target, metric, mask) for which less is better. First the points without scene
/// data that can be ranked in a shot (MetricSummary::counts_over_scenes()), as multiples of baseline_over_scenes().
/// Then the points that the study compares with a point that differs in a parameter (comparisons_of()), with scene data
/// or not, as multiples of that point: over the same shots, without ranks.
std::vector<OverScenesRow> errors_over_scenes(std::span<const MetricSummary> errors, const nlohmann::json& manifest,
                                              double margin = PrimaryComparisons().margin,
                                              const std::vector<ComparedPoint>& compared = {});
