#pragma once
#include "groundtruth/reference/reference.h"

#include <span>
#include <string>
#include <vector>

/// `incident`, `camera_radiance` or `on_screen` as specular radiance: times `reflectance`. The reference must have a
/// ladder.
ReferenceOutput reflected(const Reference& reference, const ReferenceOutput& incident);

/// How far one image is from another of the same samples. Half A is compared with half A, and half B with half B:
/// shared noise cancels, and the product of both differences has no noise on average.
struct LadderDifference {
    double mean = 0;          ///< mean of (lower - upper), over RGB and pixels: signed, so that steps add up
    double mean_error = 0;    ///< its standard error
    double square = 0;        ///< mean of (lower - upper)^2, without the noise's part; may be negative
    double square_error = 0;  ///< its standard error, if the noise of a half is normal
};

/// Differences over the pixels where `inside` is nonzero. All 0 without such pixels.
LadderDifference ladder_difference(const ReferenceOutput& upper, const ReferenceOutput& lower,
                                   std::span<const uint8_t> inside);

/// A rung of the truth ladder below `specular`.
struct LadderRung {
    std::string name;       ///< "split_sum", "camera_radiance", "on_screen"
    std::string costs;      ///< the approximation of this step, in words
    LadderDifference step;  ///< from the rung above
    LadderDifference from_truth;
};

struct LadderSummary {
    double mean_specular = 0;    ///< of the truth, over RGB and pixels
    double on_screen_share = 0;  ///< mean over the pixels
    size_t pixels = 0;
    std::vector<LadderRung> rungs;
};

/// The rungs over the pixels where reflectance and `inside` are not zero (`inside` empty: everywhere). The reference
/// must have a ladder.
LadderSummary summarize_ladder(const Reference& reference, std::span<const uint8_t> inside = {});
