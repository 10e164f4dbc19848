#pragma once
#include <cstddef>
#include <span>
#include <vector>

/// A point of a contest (a shot, or the scenes together) compared with the contest's best measured point.
struct AgainstBest {
    size_t contest = 0;
    double p = 1;  ///< two-sided, of "both are alike"
    /// Degrees of freedom of p's Student's t, if all pairs of the contest nearly share the variance; 0: each has its
    /// own.
    double degrees = 0;
};

/// p-values of "this point is no worse than the truly best", adjusted for all points of all contests, in the given
/// order. `points`: the number of points of each contest, with the best measured one.
///
/// The best measured point was chosen for its luck as well, so each p stands for all pairs that the choice was made
/// from. Points leave their contests by ascending p. A p is multiplied by the number of pairs of points that are still
/// there: C(r, 2), summed over the contests. By Bonferroni's inequality a pair of truly equal points is called
/// different with at most the level's probability. Worse points leave first, and the rest is judged among fewer.
///
/// This is Holm's procedure (1979) with the logical relations of pairs (Shaffer 1986, "Modified Sequentially Rejective
/// Multiple Test Procedures"). It steps like a model confidence set (Hansen, Lunde, Nason 2011, "The Model Confidence
/// Set"), whose remaining members may all be the best. Pairs that share a variance depend on each other: there the tail
/// of the studentised range (Tukey) replaces C(r, 2) p if it is less. Simulated in tests/experiments/evaluation.
std::vector<double> adjusted_for_choice(std::span<const AgainstBest> comparisons, std::span<const size_t> points);
