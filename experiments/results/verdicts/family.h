#pragma once
#include <cstddef>
#include <span>
#include <vector>

/// One of several points of a contest (a shot, or the scenes together) beside the best measured of them.
struct AgainstBest {
    size_t contest = 0;
    double p = 1;  ///< two-sided, of "both are alike"
    /// Of Student's t that p is of, where all pairs of the contest nearly share the variance; 0: each has its own.
    double degrees = 0;
};

/// p-values of "this point is no worse than the truly best", adjusted for all points of all contests, in the order
/// given. `points`: how many each contest has, the best measured one included.
///
/// Which point measures best is chance, too: a point that nobody chose is compared with one that was chosen for its
/// luck. So each p stands for all pairs that the choice was made from. By ascending p, point after point leaves its
/// contest, and a p is multiplied by the number of pairs of those that are still in theirs: C(r, 2), summed over the
/// contests. Of points that are truly alike, a pair is thus called different with a probability of at most the level,
/// by Bonferroni's inequality; where some are worse, those leave first, and the rest is judged among fewer. It is
/// Holm's procedure (1979) with the logical relations of pairs (Shaffer 1986, "Modified Sequentially Rejective Multiple
/// Test Procedures"), stepping as a model confidence set does (Hansen, Lunde, Nason 2011, "The Model Confidence Set"),
/// whose members at the end may all be the best. Where the variance is shared, pairs depend on each
/// other: the tail of the studentised range (Tukey) takes the place of C(r, 2) p where it is less. Simulated in
/// tests/experiments/evaluation.
std::vector<double> adjusted_for_choice(std::span<const AgainstBest> comparisons, std::span<const size_t> points);
