#pragma once
#include "groundtruth/reference/reference.h"

#include <span>
#include <string>
#include <vector>

/// `incident`, `camera_radiance` or `on_screen` as specular radiance: times `reflectance`. The reference must have a
/// ladder.
ReferenceOutput reflected(const Reference& reference, const ReferenceOutput& incident);

/// How far one image is from another, both of the same samples. Half A of one is compared with half A of the other, and
/// so for B: the noise that both share cancels, and the product of both halves' differences has none on average.
struct LadderDifference {
    double mean = 0;          ///< mean of (lower - upper), over RGB and pixels: signed, so that steps add up
    double mean_error = 0;    ///< its standard error
    double square = 0;        ///< mean of (lower - upper)^2, without the noise's part; it can come out negative
    double square_error = 0;  ///< its standard error, if the noise of a half is normal
};

/// Over the pixels where `inside` is nonzero. All 0 if there is none.
LadderDifference ladder_difference(const ReferenceOutput& upper, const ReferenceOutput& lower,
                                   std::span<const uint8_t> inside);

/// A rung of the truth ladder below `specular`.
struct LadderRung {
    std::string name;       ///< "split_sum", "camera_radiance", "on_screen"
    std::string costs;      ///< the approximation of the step to it, in words
    LadderDifference step;  ///< from the rung above
    LadderDifference from_truth;
};

struct LadderSummary {
    double mean_specular = 0;    ///< of the truth, over RGB and pixels
    double on_screen_share = 0;  ///< mean over the pixels
    size_t pixels = 0;
    std::vector<LadderRung> rungs;
};

/// The rungs over the pixels whose reflectance is not zero and where `inside` is not (empty: everywhere). The reference
/// must have a ladder.
LadderSummary summarize_ladder(const Reference& reference, std::span<const uint8_t> inside = {});
