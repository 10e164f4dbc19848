#pragma once
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

#include <span>
#include <string>
#include <vector>

/// Whether a renderer's frames err more than those that it rendered before: the verdict that fails a build.
namespace judgement {
inline constexpr const char* better = "better";
inline constexpr const char* worse = "worse";
inline constexpr const char* equivalent = "equivalent";  ///< neither, and certainly within the margin
inline constexpr const char* undecided = "undecided";
inline constexpr const char* identical = "identical";  ///< the same bytes, of which nothing is measured
}  // namespace judgement

/// At which each verdict over all views is decided: builds are judged daily, and each false alarm costs a morning.
inline constexpr double judge_significance = 0.01;

struct JudgedView {
    std::string shot;
    double ratio = 1, low = 1, high = 1;  ///< error over that of the frames before, with its 95 % interval
    double p_holm = 1;                    ///< adjusted for the number of views
    double detectable = 1;                ///< the ratio that 95 % of such comparisons of one view would call worse
    std::string verdict;                  ///< judgement::
};

struct Judgement {
    std::vector<JudgedView> views;
    std::string verdict;  ///< worse if a view is, else better if one is, else equivalent if all are, else undecided
};

/// By the primary error of `point` over that of `against`, of each shot its mean over frames or its only frame,
/// Holm-adjusted over the shots. Fails with Error where that of a shot is not known with all that is random in it, and
/// says why.
Judgement judge_effects(std::span<const EffectRow> effects, const PrimaryComparisons& primary, const PointName& point,
                        const PointName& against);

/// Whether both points have the same values, to the last digit, of every seed, shot, frame, target, metric and mask
/// that is measured of either: their frames are taken for identical then.
bool measure_alike(std::span<const ResultRow> rows, const PointName& point, const PointName& against);
