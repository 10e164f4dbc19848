#pragma once
#include "groundtruth/reference/reference.h"

#include <cstdint>
#include <span>
#include <vector>

/// Errors of radiances below this share of the image's mean are relative to this share, not to the radiance.
inline constexpr double relative_error_floor = 0.01;

/// relative_error_floor times the mean of `output` over RGB and over the pixels that are not background.
double radiance_floor(const Reference& reference, const ReferenceOutput& output);

/// Standard error of each pixel relative to its radiance: sqrt(mean over RGB of variance) / max(mean over RGB of
/// `mean`, radiance_floor()). One channel; 0 where the variance is 0.
HostImage relative_error(const Reference& reference, const ReferenceOutput& output);

/// Share of the pixels, without background, whose relative_error() of `specular` is at most `target`; 1 without pixels.
/// Weigh other pixels by their variance, or mask them.
float reached_share(const Reference& reference, float target);

struct ErrorSummary {
    double median = 0, p95 = 0, mean = 0;
    size_t pixels = 0;
};

/// relative_error() over the pixels where `inside` is nonzero (empty: all that are not background). All 0 if there is
/// none.
ErrorSummary relative_error_summary(const Reference& reference, const ReferenceOutput& output,
                                    std::span<const uint8_t> inside = {});
