#pragma once
#include "groundtruth/reference/reference.h"

#include <cstdint>
#include <span>
#include <vector>

/// Radiances below this share of the image's mean are judged against it and not against themselves.
inline constexpr double relative_error_floor = 0.01;

/// relative_error_floor times the mean of `output` over RGB and over the pixels that are not background.
double radiance_floor(const Reference& reference, const ReferenceOutput& output);

/// Standard error of each pixel relative to its radiance: sqrt(mean over RGB of variance) / max(mean over RGB of
/// `mean`, radiance_floor()). One channel; 0 where the variance is 0.
HostImage relative_error(const Reference& reference, const ReferenceOutput& output);

/// Share of the pixels, without the background, whose relative_error() of `specular` is at most `target`; 1 if there
/// are none. A pixel that is above it is not truth to that precision: weigh it by its variance, or mask it.
float reached_share(const Reference& reference, float target);

struct ErrorSummary {
    double median = 0, p95 = 0, mean = 0;
    size_t pixels = 0;
};

/// relative_error() over the pixels where `inside` is nonzero (empty: all that are not background). All 0 if there is
/// none.
ErrorSummary relative_error_summary(const Reference& reference, const ReferenceOutput& output,
                                    std::span<const uint8_t> inside = {});
