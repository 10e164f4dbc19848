#include "metrics/jod_interval.h"

#include "metrics/statistics/quantiles.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>

namespace {

/// The exponents of Q(v) = Q_0 + b v^k, where Q is pooled_difference() and v the noise's variance. Differences grow as
/// the square root of v where they are seen by themselves, faster where others mask them.
constexpr double least_exponent = 0.5, greatest_exponent = 1.5;

double pooled(const std::vector<VisibleDifferences>& frames, bool is_still) {
    return pooled_difference(frames, is_still ? 3 : cvvdp_channels, is_still, cvvdp_0_5_6_calibration());
}

double jod_of_pooled(double difference) { return jod(std::max(difference, 0.0), cvvdp_0_5_6_calibration()); }

double extended(double at_one, double at_two, double exponent) {
    return at_one - (at_two - at_one) / (std::exp2(exponent) - 1);
}

/// `frames` with one band of others.
std::vector<VisibleDifferences> with_band_of(std::vector<VisibleDifferences> frames,
                                             const std::vector<VisibleDifferences>& others, size_t band) {
    for (size_t f = 0; f < frames.size(); ++f) frames[f][band] = others[f][band];
    return frames;
}

}  // namespace

double relative_noise(const HostImage& half_a, const HostImage& half_b, const Viewing& viewing) {
    const double most = viewing.display.peak / viewing.nits_per_unit;
    double sum = 0;
    for (size_t i = 0; i < half_a.values.size(); ++i) {
        const double a = half_a.values[i], b = half_b.values[i], noise = (std::min(a, most) - std::min(b, most)) / 2,
                     of_value = noise * noise * relative_weight(std::min((a + b) / 2, most));
        if (std::isfinite(of_value)) sum += of_value;
    }
    return sum / double(half_a.values.size());
}

double jod_of(const std::vector<VisibleDifferences>& frames, bool is_still) {
    return jod_of_pooled(pooled(frames, is_still));
}

JodInterval jod_interval(const DifferenceFrom& differences, bool is_still) {
    const auto& [truth, half_a, half_b] = differences;
    const double own = pooled(truth, is_still), of_a = pooled(half_a, is_still), of_b = pooled(half_b, is_still),
                 twice = (of_a + of_b) / 2;
    std::vector<double> changes;
    for (size_t band = 0; band < truth[0].size(); ++band)
        changes.push_back((pooled(with_band_of(truth, half_a, band), is_still) -
                           pooled(with_band_of(truth, half_b, band), is_still)) /
                          2);
    const double ends[] = {own, extended(own, twice, least_exponent), extended(own, twice, greatest_exponent)};
    // A rare bright path is seen in all bands at once, so that their changes have one sign: then the change of the
    // whole score says more than theirs. It is one draw, which alone would be too few.
    const SharedScatter scatter = scatter_of_terms(changes, double(changes.size()));
    const double of_bands = std::sqrt(scatter.variance), deviation = std::max(of_bands, std::abs(of_a - of_b) / 2),
                 half_width = student_t_quantile(0.975, scatter.degrees) * deviation;
    JodInterval interval{.jod = {.low = jod_of_pooled(std::ranges::max(ends) + half_width),
                                 .high = jod_of_pooled(std::ranges::min(ends) - half_width)},
                         .draws = {}};
    // Draws get the standard deviation in Q of the interval. Scores near 10 are clipped.
    const double scale = of_bands > 0 ? deviation / of_bands : 1;
    for (const double change : changes)
        interval.draws.push_back(jod_of_pooled(own - scale * change) - jod_of_pooled(own));
    return interval;
}
