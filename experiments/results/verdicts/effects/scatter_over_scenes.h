#pragma once
#include <array>
#include <optional>
#include <vector>

// How errors scatter over scenes, estimated from all compared points together. This scatter limits what is known about
// the point of least average error over scenes like these.

/// Fewer scenes give a mean without an interval.
inline constexpr size_t least_scenes = 4;

/// A value of each scene: as measured, and without the reference's noise by either law of its growth (Extrapolated).
/// The law is unknown but the same for all points and scenes. An interval is therefore the hull of the three intervals,
/// and p the largest of the three. The difference between the laws is no part of the scatter over scenes, and does not
/// shrink with their number.
using ScenesByLaw = std::array<std::vector<double>, 3>;
inline constexpr size_t noise_laws = std::tuple_size_v<ScenesByLaw>;

/// How a difference of two points scatters over scenes, from all compared points together. `variance`: the pooled
/// variance; `degrees`: the degrees of freedom by which it moderates the variance of one difference. 0 degrees: none.
struct PooledScatter {
    double variance = 0, degrees = 0;

    /// (n0 v0 + (n - 1) v) / (n0 + n - 1) for a variance v over n scenes, and its degrees of freedom. The expected
    /// value of v is `share` of v0. Source: Smyth 2004, "Linear Models and Empirical Bayes Methods for Assessing
    /// Differential Expression". Alone v has n - 2 degrees, one fewer than for normal values, since logarithms of
    /// ratios are skewed.
    struct Moderated {
        double variance, degrees;
    };
    Moderated moderated(double own, size_t scenes, double share = 1) const;
};

/// Degrees of freedom of the pooled variance, besides the n - 1 of a difference's own. Chosen among 0, 3, the points'
/// own estimate (Smyth 2004) and infinitely many. Over 4 to 16 scenes of the kept studies, intervals hold 94 to 97 %
/// with 3, 88 to 97 % with 0, and 90 to 94 % with the others (experiments/results/tradeoff/README.md).
inline constexpr double pooled_degrees = 3;

/// The errors (logarithms) of each point in each scene; all points have the same scenes.
using PointsByLaw = std::vector<const ScenesByLaw*>;

/// The pooled scatter by law. It has no more degrees than the other points support: 0 with fewer than three points or
/// below least_scenes.
std::array<PooledScatter, noise_laws> pooled_scatter(const PointsByLaw& points);

/// A point's probability to err least of all points on average over scenes like these, and to err at most near_first
/// more than the point that does.
struct ChanceOverScenes {
    double first = 0, near = 0;
};
inline constexpr double near_first = 0.1;

/// Estimated from some thousand draws of means by Student's t; each law holds in a third of the draws. Deterministic.
/// Empty below two points or least_scenes.
std::vector<ChanceOverScenes> chances_over_scenes(const PointsByLaw& points,
                                                  const std::array<PooledScatter, noise_laws>& pooled);
