#pragma once
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/effects/scatter_over_scenes.h"
#include "experiments/results/verdicts/summary.h"

#include <nlohmann/json.hpp>

// What holds over scenes: they are the sample. Shots of one scene, and scenes of one asset, are averaged first.

/// A value of one shot.
struct ShotValue {
    std::string asset;
    double value = 0;
};

/// A mean with its 95 % interval over scenes like these: Student's t, of a variance that PooledScatter moderates.
struct MeanOverScenes {
    double value = 0;
    std::optional<double> low, high;  ///< none below least_scenes
    std::optional<double> p;          ///< two-sided, of "the mean is 0"; also none where all scenes say the same
    size_t scenes = 0;
    double standard_error = 0, degrees = 0;  ///< of `value`; 0 below least_scenes
};
/// Fails with Error where there is no value.
MeanOverScenes mean_over_scenes(std::span<const ShotValue> values);

/// The 95 % interval of the mean by resampling the scenes (BCa; Efron 1987, "Better Bootstrap Confidence Intervals"),
/// for comparison alone: of few scenes it is too narrow. The same numbers whenever it is asked with the same `seed`;
/// none below least_scenes, or where all are the same.
std::optional<std::pair<double, double>> bootstrap_over_scenes(std::span<const double> values, unsigned seed = 1);

/// One shot's errors of all that is compared over scenes, with and without the reference's noise.
struct ShotErrors {
    std::string asset;
    std::optional<Extrapolated> divisor;  ///< the baseline's; none where it is no measure, and the shot counts for none
    std::map<PointName, Extrapolated> errors;
};

/// How many scenes like these show a difference of `worth_deciding` in the mean of logarithms of ratios that scatter by
/// `deviation` (a standard deviation over scenes), with 80 % power at a significance of 5 % (two-sided, Student's t of
/// n - 2 degrees as above): at least least_scenes.
double scenes_needed(double deviation);
inline constexpr double worth_deciding = 0.1;  ///< 10 % more error

/// What scenes say of the errors of one point.
struct OverScenes {
    std::string technique, point;
    size_t scenes = 0, shots = 0;                     ///< in which it and the baseline have an error above 0
    double ratio = 1;                                 ///< geometric mean over scenes of error / the baseline's
    std::optional<double> low, high;                  ///< its MeanOverScenes, by all laws
    std::optional<double> rank, rank_low, rank_high;  ///< 1: the least; ends with any one scene left out
    std::optional<double> over_best, over_best_low, over_best_high;  ///< error / that of the first rank
    std::optional<double> p_holm;        ///< of "over_best is 1", adjusted_for_choice() among all that is compared here
    std::optional<double> p_equivalent;  ///< of "over_best is not within the margin", adjusted (Holm)
    std::optional<double> chance_first, chance_near;  ///< ChanceOverScenes, among those that are ranked
    std::string standing;                             ///< see standings.h; of what is ranked over least_scenes or more
    /// To tell it and the first rank apart where one errs worth_deciding more; ends by those of the deviation (95 %, of
    /// normal logarithms). None below least_scenes.
    std::optional<double> scenes_needed, scenes_needed_low, scenes_needed_high;
    ScenesByLaw logarithms = {};  ///< of the ratio
};

/// By ascending rank, those without one last. Ranked, over the shots that they have in common, is what lacks at most
/// the share `lacking` of the shots that count. The first rank was chosen from the scenes that it is compared over:
/// `standing` says which points may be the best (the confidence set of set_standings()), not how far the first is
/// ahead. `margin`: see PrimaryComparisons.
std::vector<OverScenes> compare_over_scenes(std::span<const ShotErrors> shots, double lacking = 0,
                                            double margin = PrimaryComparisons().margin);

/// So many of the shots may a point lack an error above 0 in, and be ranked.
inline constexpr double most_lacking = 0.1;

/// The median over scenes with its interval of at least 95 % from order statistics, exact for whatever distribution;
/// none of less than six.
struct MedianOverScenes {
    double value = 0;
    std::optional<double> low, high;
};
/// Fails with Error where there is no value.
MedianOverScenes median_over_scenes(std::vector<double> values);
MedianOverScenes median_over_scenes(const ScenesByLaw& values);

/// The point that errors are given as multiples of: `none`, no screen-space reflections, where the study has it, else
/// its first baseline, else its first point. Fails with Error where the manifest has no techniques.
PointName baseline_over_scenes(const nlohmann::json& manifest);

/// The baseline's error in a shot, to divide by; none where any error would be a huge multiple of it: it is not
/// distinguishable from 0, is not twice what the reference's noise scores, or is below a millionth of the shot's
/// largest, as rounding leaves it. `errors`: of that shot, by one target, metric and mask.
std::optional<Extrapolated> divisor_of(std::span<const MetricSummary* const> errors, const PointName& baseline);

/// A row of over_scenes.csv.
struct OverScenesRow : OverScenes {
    std::string target, metric, mask, baseline_technique, baseline_point;

    COLUMNS(OverScenesRow, target, metric, mask, technique, point, baseline_technique, baseline_point, scenes, shots,
            ratio, low, high, rank, rank_low, rank_high, over_best, over_best_low, over_best_high, p_holm, p_equivalent,
            chance_first, chance_near, standing)
};

/// Of every error (target, metric, mask) for which less is better, the points that can be ranked in a shot
/// (MetricSummary::counts_over_scenes()) and use no scene data, as multiples of baseline_over_scenes(). Then the points
/// that the study compares with one that differs in a parameter (comparisons_of()), scene data or not, as multiples of
/// that, over the shots that count for the former: without ranks.
std::vector<OverScenesRow> errors_over_scenes(std::span<const MetricSummary> errors, const nlohmann::json& manifest,
                                              double margin = PrimaryComparisons().margin,
                                              const std::vector<ComparedPoint>& compared = {});
