#include "metrics/cvvdp/sensitivity.h"

#include "metrics/cvvdp/fast_power.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double least_background = 0.005, greatest_background = 1e4;  // cd/m2
constexpr double least_frequency = 0.1, greatest_frequency = 64;       // cycles per degree
constexpr unsigned last = sensitivity_nodes - 1;

/// A few pixels at a time in three loops, of which the compiler can vectorise the first and the last.
constexpr unsigned chunk = 256;

void places_among_nodes(const float* __restrict log2_background, float* __restrict place, unsigned count) {
    const float low = float(std::log2(least_background));
    const float scale = float(last / std::log2(greatest_background / least_background));
    for (unsigned x = 0; x < count; ++x)
        place[x] = std::min(std::max((log2_background[x] - low) * scale, 0.0f), float(last));
}

/// Replaces places by the linear interpolation between nodes.
void interpolate(const float* __restrict nodes, float* __restrict place, unsigned count) {
    for (unsigned x = 0; x < count; ++x) {
        const int node = std::min(int(place[x]), int(last) - 1);
        place[x] = nodes[node] + (place[x] - float(node)) * (nodes[node + 1] - nodes[node]);
    }
}

void exp2_row(const float* __restrict in, float* __restrict out, unsigned count) {
    for (unsigned x = 0; x < count; ++x) out[x] = fast_exp2(in[x]);
}

}  // namespace

BandSensitivity::BandSensitivity(double frequency, const CvvdpCalibration& calibration) {
    const double place = last * std::log(frequency / least_frequency) / std::log(greatest_frequency / least_frequency);
    const int node = std::clamp(int(std::ceil(place)) - 1, 0, int(last) - 1);  // the last one below
    const double share = place - node;
    const double correction = calibration.sensitivity_decibels / 20;
    for (unsigned channel = 0; channel < cvvdp_channels; ++channel)
        for (unsigned background = 0; background < sensitivity_nodes; ++background) {
            const auto& row = sensitivity_table()[channel][background];
            const double log10 = row[node] + share * (double(row[node + 1]) - row[node]) + correction;
            log2_at_background_[channel][background] = float(log10 * std::log2(10.0));
        }
}

void BandSensitivity::row(unsigned channel, const float* log2_background, float* out, unsigned width) const {
    std::array<float, chunk> place;
    for (unsigned x = 0; x < width; x += chunk) {
        const unsigned count = std::min(chunk, width - x);
        places_among_nodes(log2_background + x, place.data(), count);
        interpolate(log2_at_background_[channel].data(), place.data(), count);
        exp2_row(place.data(), out + x, count);
    }
}
