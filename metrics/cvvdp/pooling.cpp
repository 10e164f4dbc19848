#include "metrics/cvvdp/pooling.h"

#include <cmath>

namespace {

/// (v + epsilon)^e - epsilon^e for v >= 0.
double safe_power(double v, double e, double epsilon) { return std::pow(v + epsilon, e) - std::pow(epsilon, e); }

}  // namespace

double pooled_difference(const std::vector<VisibleDifferences>& frames, unsigned channels, bool is_still,
                         const CvvdpCalibration& c) {
    double over_frames = 0;
    for (const VisibleDifferences& frame : frames) {
        double over_channels = 0;
        for (unsigned channel = 0; channel < channels; ++channel) {
            double over_bands = 0;
            for (size_t band = 0; band < frame.size(); ++band) {
                const double of_band = safe_power(frame[band][channel], 1 / c.pixel_norm, c.epsilon);
                const double base = band + 1 == frame.size() ? c.base_band_weights[channel] : 1;
                over_bands += safe_power(of_band * c.channel_weights[channel] * base, c.band_norm, c.epsilon);
            }
            over_channels += safe_power(safe_power(over_bands, 1 / c.band_norm, c.epsilon), c.channel_norm, c.epsilon);
        }
        const double of_frame = safe_power(over_channels, 1 / c.channel_norm, c.epsilon);
        if (is_still) return of_frame * c.still_weight;
        over_frames += safe_power(of_frame, c.frame_norm, c.epsilon);
    }
    return safe_power(over_frames / double(frames.size()), 1 / c.frame_norm, c.epsilon);
}

double jod(double pooled_difference, const CvvdpCalibration& c) {
    constexpr double straight_below = 0.1;
    if (pooled_difference > straight_below) return 10 - c.jod_factor * std::pow(pooled_difference, c.jod_exponent);
    const double slope = c.jod_factor * std::pow(straight_below, c.jod_exponent) / straight_below;
    return 10 - slope * pooled_difference;
}
