#pragma once
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

#include <span>
#include <string>
#include <vector>

/// Whether a renderer's frames err more than its earlier frames: the verdict that fails a build.
namespace judgement {
inline constexpr const char* better = "better";
inline constexpr const char* worse = "worse";
inline constexpr const char* equivalent = "equivalent";  ///< neither, and certainly within the margin
inline constexpr const char* undecided = "undecided";
inline constexpr const char* identical = "identical";  ///< the same bytes, so nothing is measured
}  // namespace judgement

/// Significance of each verdict over all views: builds are judged daily, and each false alarm costs a morning.
inline constexpr double judge_significance = 0.01;

struct JudgedView {
    std::string shot;
    double ratio = 1, low = 1, high = 1;  ///< error / error of the earlier frames, with its 95 % interval
    double p_holm = 1;                    ///< adjusted for the number of views
    double detectable = 1;                ///< the ratio that 95 % of such comparisons of one view would call worse
    std::string verdict;                  ///< judgement::
};

struct Judgement {
    std::vector<JudgedView> views;
    std::string verdict;  ///< worse if any view is, else better if any is, else equivalent if all are, else undecided
};

/// Judges `point` by its primary error / that of `against`, in each shot the mean over frames or the only frame,
/// Holm-adjusted over the shots. Fails with Error, which says why, if a shot's effect has no interval of all that is
/// random.
Judgement judge_effects(std::span<const EffectRow> effects, const PrimaryComparisons& primary, const PointName& point,
                        const PointName& against);

/// Whether both points have equal values, to the last digit, of every measured seed, shot, frame, target, metric and
/// mask. Their frames then count as identical.
bool measure_alike(std::span<const ResultRow> rows, const PointName& point, const PointName& against);
