#pragma once
#include "metrics/score.h"

#include <map>
#include <span>
#include <string>
#include <vector>

/// What the reference's noise does to one error of one point. It makes errors of several points against the same
/// reference comparable: their noise is mostly the same, and cancels in ratios.
///
/// Half the change of an error, when half A of the reference replaces half B, is a sum over pixels with independent
/// terms of random sign. `sums` are its parts over groups of pixels, drawn by chance, the same for all points. The sum
/// over groups of (x_a / E_a - x_b / E_b)^2 estimates the variance of ln(E_a / E_b). Errors that cannot be freed of the
/// noise have `growth` instead, see extrapolated_scatter().
struct ReferenceNoise {
    std::string shot, frame, technique, point, target, metric, mask;
    std::vector<float> sums;
    NoiseGrowth growth = {};
};

/// The error that the noise of the lit colour adds, as lit_noise.h estimates it.
struct LitNoise {
    double added = 0;       ///< mean addition to the error; 0 for errors linear in the result
    double half_width = 0;  ///< of the error's 95 % interval from this noise alone
};

/// This many groups give the variance to sqrt(2 / 256) = 9 %, unless few pixels have most of it.
inline constexpr size_t noise_groups = 256;

/// For each group, the masked sum of the plane's finite pixels / the number of all such pixels. The groups add up to
/// the masked mean.
std::vector<double> group_sums(const Plane& plane, const Mask& mask);

/// Half the change of each pixel's error when half A of the reference replaces half B. The reference must have halves,
/// and the metric must be a mean of weighted squares.
Plane swapped_error(const Metric& metric, const MetricReference& reference, const HostImage& test);

/// The `frame` of rows over all frames of a shot: empty, so that the column holds numbers alone.
inline const std::string over_frames;

/// Names one error of a point in a shot.
struct ErrorName {
    std::string target, metric, mask, frame;
    auto operator<=>(const ErrorName&) const = default;
};

/// Element-wise sums of rows, and their count, for means.
struct SumOfRows {
    std::vector<double> total;
    size_t count = 0;

    template <class Row>
    void add(const Row& row) {
        total.resize(row.size());
        for (size_t i = 0; i < row.size(); ++i) total[i] += row[i];
        ++count;
    }
};
using SumsOfErrors = std::map<ErrorName, SumOfRows>;

/// Adds ReferenceNoise::sums of one result of one seed; `frame` as in ResultRow. Frames that enter a shot's mean are
/// added as over_frames: noises of different poses are independent and partly cancel, noises of one pose do not.
void add_swapped_errors(SumsOfErrors& noise, const std::string& frame, const std::string& target,
                        const MetricReference& reference, const HostImage& test, std::span<const Mask> masks);
/// Adds ReferenceNoise::growth of an extrapolated error, as score() gives it.
void add_growth(SumsOfErrors& noise, const ErrorName& error, const NoiseGrowth& growth);

/// Means over what was added; `shared` holds shot, technique and point. An error known over all frames replaces those
/// of single frames.
std::vector<ReferenceNoise> means_of(const SumsOfErrors& noise, const ReferenceNoise& shared);
