#pragma once
#include "groundtruth/reference/reference.h"

#include <string>
#include <utility>
#include <vector>

/// Tests the stated variance by the two halves: z^2 = (A - B)^2 / (4 variance), and z has the sign of A - B.
///
/// Let B be the share of the scatter of the 16 batches of a pass that lies between its halves. If batches are
/// exchangeable, B is 1/15 on average for any distribution, and z^2 = 14 B / (1 - B), which is convex, has a mean of at
/// least 1 (Jensen); normal batches give 14/12 (the F distribution). Merged passes and rare bright paths bring the mean
/// from 14/12 towards 1. A correct render is therefore between 1 and 14/12, up to the noise of a mean over pixels.
/// Dependent halves are below this range, understated variances above.
struct HalfAudit {
    double mean_z_squared = 0;    ///< over the pixels that have any variance; each is the mean of its channels
    double low = 0, high = 0;     ///< range of a correct render
    double correlation = 0;       ///< of z between horizontal neighbours; 0 if pixels are independent
    double most_correlation = 0;  ///< the largest of a correct render, of either sign
    size_t pixels = 0;

    /// The bounds are 6 standard errors: a correct render fails less than once in 10^6 times. True below 100 pixels,
    /// which are too few to judge.
    bool is_passed() const;
};

/// `weights`: samples of half A and half B, for outputs whose halves may lack samples; pixels without samples do not
/// count.
HalfAudit audit_halves(const ReferenceOutput& output, const HostImage* weights = nullptr);

/// Share of missing light above which there is a warning: a tenth of a usual reference's error.
inline constexpr double largest_light_cut = 1e-3;

struct ReferenceAudit {
    std::vector<std::pair<std::string, HalfAudit>>
        outputs;  ///< of all outputs with noise, by the names of their layers
    double light_cut =
        0;  ///< Reference::cut_share over the image: share of all light that paths beyond max_depth carry
    std::vector<std::string> warnings;  ///< sentences, without a full stop; empty if there are none
};
/// Audits a finished reference: audit_halves() of all outputs, and the light that its depth cuts off.
ReferenceAudit audit_reference(const Reference& reference);
