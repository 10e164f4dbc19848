#include "metrics/cvvdp/temporal_filters.h"

#include "core/error.h"

#include <cmath>
#include <numbers>

namespace {

/// Share of a flicker of `hertz` that the channel passes.
double response(unsigned channel, double hertz, const CvvdpCalibration& c) {
    const double beta = c.temporal_beta[channel];
    const double centre = channel == 3 ? std::pow(c.transient_hertz, beta) : 0;
    const double distance = std::pow(hertz, beta) - centre;
    return std::exp(-(channel == 3 ? distance * distance : distance) / c.temporal_sigma[channel]);
}

}  // namespace

unsigned filter_window(double frames_per_second) {
    if (!(frames_per_second >= least_frame_rate && frames_per_second <= greatest_frame_rate))
        fail("frames per second = ", frames_per_second, " is outside [", least_frame_rate, ", ", greatest_frame_rate,
             "]");
    constexpr double half_seconds = 0.125;
    return 2 * unsigned(std::ceil(half_seconds * frames_per_second)) + 1;
}

PerCvvdpChannel<std::vector<float>> temporal_filters(double frames_per_second, const CvvdpCalibration& calibration) {
    const int taps = int(filter_window(frames_per_second)), half = taps / 2;
    PerCvvdpChannel<std::vector<float>> filters;
    for (unsigned channel = 0; channel < cvvdp_channels; ++channel)
        for (int j = 0; j < taps; ++j) {
            // The inverse discrete Fourier transform of a real, even spectrum. As in the original, its last frequency
            // counts as half the frame rate.
            double sum = response(channel, 0, calibration);
            for (int k = 1; k <= half; ++k)
                sum += 2 * response(channel, k * frames_per_second / 2 / half, calibration) *
                       std::cos(2 * std::numbers::pi * k * (j - half) / taps);
            filters[channel].push_back(float(sum / taps));
        }
    return filters;
}
