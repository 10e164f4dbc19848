#pragma once
#include "metrics/score.h"

#include <map>
#include <span>
#include <string>
#include <vector>

/// What the noise of the reference does to one error of one technique point, so that errors of other points against the
/// same reference can be compared with it: their noise is mostly the same, and cancels. Half the error's change when
/// half A of the reference is believed in place of half B is a sum over pixels, whose terms are as likely of one sign
/// as of the other and independent of each other. `sums` are those of groups that the pixels fall into by chance, the
/// same for all points; sum over groups of (x_a / E_a - x_b / E_b)^2 estimates the variance of ln(E_a / E_b). Errors
/// that cannot be freed of the noise have `growth` in their place, see extrapolated_scatter().
struct ReferenceNoise {
    std::string shot, frame, technique, point, target, metric, mask;
    std::vector<float> sums;
    NoiseGrowth growth = {};
};

/// The error that the noise of the lit colour adds, as lit_noise.h estimates it.
struct LitNoise {
    double added = 0;       ///< to the error, on average; 0 for errors that are linear in the result
    double half_width = 0;  ///< of the 95 % interval of the error due to this noise
};

/// So many that the variance is known to sqrt(2 / 256) = 9 %, where no few pixels have most of it.
inline constexpr size_t noise_groups = 256;

/// Masked sums of a plane's finite pixels by group, over their number: they add up to the masked mean.
std::vector<double> group_sums(const Plane& plane, const Mask& mask);

/// Half the change of the error of each pixel when half A of the reference is believed in place of half B. Only for
/// references with halves, and metrics that are means of weighted squares.
Plane swapped_error(const Metric& metric, const MetricReference& reference, const HostImage& test);

/// The `frame` of rows that stand for all frames of a shot: none, so that the column holds numbers alone.
inline const std::string over_frames;

/// Names one error of a point in a shot.
struct ErrorName {
    std::string target, metric, mask, frame;
    auto operator<=>(const ErrorName&) const = default;
};

/// Sums over what was added, number by number, to make their means of.
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

/// Adds ReferenceNoise::sums of one result of one seed; `frame` as in ResultRow. Frames of a shot that its mean is of
/// are added as over_frames: noises of poses that look different are independent and partly cancel, those of one pose
/// do not.
void add_swapped_errors(SumsOfErrors& noise, const std::string& frame, const std::string& target,
                        const MetricReference& reference, const HostImage& test, std::span<const Mask> masks);
/// Adds ReferenceNoise::growth of an error that is extrapolated, as score() gives it.
void add_growth(SumsOfErrors& noise, const ErrorName& error, const NoiseGrowth& growth);

/// The means over what was added; `shared` holds shot, technique and point. Of quantities that are known over all
/// frames, those of single frames are left out.
std::vector<ReferenceNoise> means_of(const SumsOfErrors& noise, const ReferenceNoise& shared);
