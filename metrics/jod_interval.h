#pragma once
#include "core/host_image.h"
#include "metrics/cvvdp/display.h"
#include "metrics/cvvdp/pooling.h"
#include "metrics/statistics/estimates.h"

// The interval that the truth's noise leaves to a score of ColorVideoVDP. The noise lowers the score. Images are scored
// three times: against the truth, whose noise has the variance v, and against both of its halves, which have 2 v. From
// these scores the interval reaches to no noise.

/// Above this relative variance of the truth, its noise hides what a good test lacks: no law of its growth leads back.
inline constexpr double most_noise_of_jod = 1.0 / 64;

/// The variance of the truth's noise relative to the truth and weighted as relmse: the mean over pixels and channels,
/// as far as the display shows their light. Linear images of one size; the truth is the mean of its halves.
double relative_noise(const HostImage& half_a, const HostImage& half_b, const Viewing& viewing);

struct JodInterval {
    Interval jod;  ///< 95 %
    /// For each band of frequencies, half the change of the JOD when half A replaces half B as the truth in this band
    /// alone. The noise of most pixels is independent from band to band, so these are draws of the noise in the JOD. A
    /// rare bright path moves all bands alike: where the whole change is larger, all draws are longer by one factor.
    std::vector<double> draws;
};

/// What is visible of the difference of all frames of a video, or of one still, from one truth.
struct DifferenceFrom {
    std::vector<VisibleDifferences> truth, half_a, half_b;
};
JodInterval jod_interval(const DifferenceFrom& differences, bool is_still);

/// JOD of a score's frames.
double jod_of(const std::vector<VisibleDifferences>& frames, bool is_still);
