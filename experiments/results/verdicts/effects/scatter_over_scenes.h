#pragma once
#include <array>
#include <optional>
#include <vector>

// How errors scatter over scenes, as all compared points tell it together, and what that leaves open about who errs
// least on average over scenes like these.

/// Of fewer scenes nothing is known but their mean.
inline constexpr size_t least_scenes = 4;

/// A value of each scene, as measured, and without the reference's noise by either law of its growth (Extrapolated).
/// Which law holds is not known, but it is the same for all points and scenes: an interval is the hull of the three
/// that each has by itself, and p the largest. What either law says is thus no part of the scatter over scenes, and
/// does not shrink with their number.
using ScenesByLaw = std::array<std::vector<double>, 3>;
inline constexpr size_t noise_laws = std::tuple_size_v<ScenesByLaw>;

/// What all compared points say together of how a difference of two of them scatters over scenes: its variance, and by
/// how many degrees of freedom the variance of one difference is moderated towards it. None: 0 degrees.
struct PooledScatter {
    double variance = 0, degrees = 0;

    /// (n0 v0 + (n - 1) v) / (n0 + n - 1) of a variance v that n scenes tell, `share` of v0 being expected of it, with
    /// its degrees of freedom (Smyth 2004, "Linear Models and Empirical Bayes Methods for Assessing Differential
    /// Expression"). Alone it has n - 2, one fewer than of normal values, since logarithms of ratios are skewed.
    struct Moderated {
        double variance, degrees;
    };
    Moderated moderated(double own, size_t scenes, double share = 1) const;
};

/// Degrees of freedom that the variance over all points counts for, beside the n - 1 of a difference's own. Chosen
/// among 0, 3, the points' own estimate (Smyth 2004) and infinitely many: over 4 to 16 of the kept studies' scenes
/// intervals hold 94 to 97 % with 3, 88 to 97 with 0, 90 to 94 with the others
/// (experiments/results/tradeoff/README.md).
inline constexpr double pooled_degrees = 3;

/// Points of a study by what they err in each scene (logarithms, the same scenes of all).
using PointsByLaw = std::vector<const ScenesByLaw*>;

/// By law. It counts for no more degrees than the other points tell: none of fewer than three points, or below
/// least_scenes.
std::array<PooledScatter, noise_laws> pooled_scatter(const PointsByLaw& points);

/// A point's probability to err least of all points on average over scenes like these, and to err at most near_first
/// more than the one that does.
struct ChanceOverScenes {
    double first = 0, near = 0;
};
inline constexpr double near_first = 0.1;

/// Means that Student's t leaves open, drawn some thousand times; each law holds in a third of the draws. The same
/// numbers each time. Empty below two points or least_scenes.
std::vector<ChanceOverScenes> chances_over_scenes(const PointsByLaw& points,
                                                  const std::array<PooledScatter, noise_laws>& pooled);
