#pragma once
#include "core/host_image.h"
#include "metrics/compare.h"

/// What a file holds.
struct ComparedImage {
    HostImage linear, codes;  ///< codes of radiance are not made yet
    bool is_radiance = true;  ///< else display codes
};

/// Reads radiance or codes, whichever the file's bytes say.
ComparedImage read_compared_image(const std::filesystem::path& file, const CompareOptions& options,
                                  std::vector<std::string>& warnings);

/// Warns of pixels of the reference and of the test image that are not finite or negative. Fails with Error if
/// options.fail_on_non_finite and there are such that are not finite.
void report_bad_pixels(Comparison& comparison);

/// Fills options.settings.viewing with the display that the reference's kind of values needs, unless one is named.
/// Fails with Error if nits per unit are given for a display of codes.
void choose_display(CompareOptions& options, bool is_radiance);

/// Pixels with a channel above the peak of a linear display, which shows the peak in its place; 0 for other displays.
size_t count_clipped(const HostImage& linear, const MetricSettings& settings);
void warn_of_clipped(size_t pixels, const std::filesystem::path& file, const MetricSettings& settings,
                     std::vector<std::string>& warnings);
