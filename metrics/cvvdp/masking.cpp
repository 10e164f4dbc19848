#include "metrics/cvvdp/masking.h"

#include "metrics/cvvdp/fast_power.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr unsigned radius = Masking::blur_radius;

void blur(const float* const* __restrict rows, const float* __restrict taps, float* __restrict out, unsigned width) {
    for (unsigned x = 0; x < width; ++x) {
        float sum = taps[0] * rows[radius][x];
        for (unsigned u = 1; u <= radius; ++u) sum += taps[u] * (rows[radius - u][x] + rows[radius + u][x]);
        out[x] = sum;
    }
}

/// (v + epsilon)^e - epsilon^e, exactly 0 for v = 0.
float safe_power(float v, float e, float epsilon, float offset) {
    const float power = fast_power(v + epsilon, e) - offset;
    return v > 0 ? power : 0.0f;
}

void safe_power_row(float* __restrict v, float e, float epsilon, float offset, unsigned width) {
    for (unsigned x = 0; x < width; ++x) v[x] = safe_power(v[x], e, epsilon, offset);
}

template <int channels>
void add_masks(const float* const* masks, const float* weights, float* __restrict out, unsigned width) {
    const float* a = masks[0];
    const float* b = masks[1];
    const float* c = masks[2];
    const float* d = masks[channels - 1];
    for (unsigned x = 0; x < width; ++x) {
        float sum = 1 + weights[0] * a[x] + weights[1] * b[x] + weights[2] * c[x];
        if (channels == 4) sum += weights[3] * d[x];
        out[x] = sum;
    }
}

}  // namespace

Masking::Masking(const CvvdpCalibration& c)
    : epsilon_(float(c.epsilon)),
      gain_(float(std::pow(10, c.log10_mask_gain))),
      greatest_(float(std::pow(10, c.log10_greatest_difference))),
      mask_exponent_(float(c.mask_exponent)),
      mask_offset_(float(std::pow(c.epsilon, c.mask_exponent))) {
    for (unsigned k = 0; k < cvvdp_channels; ++k) {
        exponents_[k] = float(c.masking_exponents[k]);
        offsets_[k] = float(std::pow(c.epsilon, c.masking_exponents[k]));
        for (unsigned m = 0; m < cvvdp_channels; ++m)
            cross_channels_[k][m] = float(std::exp2(c.log2_cross_channels[k][m]));
    }
    const auto gauss = [&](unsigned u) { return std::exp(-0.5 * u * u / (c.mask_blur_sigma * c.mask_blur_sigma)); };
    double sum = gauss(0);
    for (unsigned u = 1; u <= radius; ++u) sum += 2 * gauss(u);
    for (unsigned u = 0; u <= radius; ++u) taps_[u] = float(gauss(u) / sum);
}

void Masking::split(float* __restrict test_then_difference, float* __restrict reference_then_mask, unsigned width) {
    for (unsigned x = 0; x < width; ++x) {
        const float test = test_then_difference[x], reference = reference_then_mask[x];
        test_then_difference[x] = std::abs(test - reference);
        reference_then_mask[x] = std::min(std::abs(test), std::abs(reference));
    }
}

void Masking::blur_row(const float* mask, float* out, unsigned width, std::vector<float>& scratch) const {
    scratch.resize(width + 2 * radius);
    float* padded = scratch.data() + radius;
    std::copy_n(mask, width, padded);
    for (int u = 1; u <= int(radius); ++u) padded[-u] = mask[u], padded[int(width) - 1 + u] = mask[int(width) - 1 - u];
    std::array<const float*, 2 * radius + 1> shifted;
    for (unsigned k = 0; k < shifted.size(); ++k) shifted[k] = scratch.data() + k;
    blur(shifted.data(), taps_.data(), out, width);
}

void Masking::blur_column(std::span<const float* const> rows, float* out, unsigned width) const {
    std::array<float, radius + 1> taps = taps_;
    for (float& tap : taps) tap *= gain_;
    blur(rows.data(), taps.data(), out, width);
}

void Masking::scale(const float* mask, float* out, unsigned width) const {
    for (unsigned x = 0; x < width; ++x) out[x] = gain_ * mask[x];
}

void Masking::raise(unsigned channel, float* mask, unsigned width) const {
    safe_power_row(mask, exponents_[channel], epsilon_, offsets_[channel], width);
}

void Masking::apply(unsigned channel, std::span<const float* const> raised_masks, float* difference,
                    unsigned width) const {
    std::array<float, cvvdp_channels> weights{};
    for (size_t k = 0; k < raised_masks.size(); ++k) weights[k] = cross_channels_[k][channel];
    constexpr unsigned chunk = 256;
    std::array<float, chunk> masks;
    for (unsigned x0 = 0; x0 < width; x0 += chunk) {
        const unsigned count = std::min(chunk, width - x0);
        std::array<const float*, cvvdp_channels> here{};
        for (size_t k = 0; k < raised_masks.size(); ++k) here[k] = raised_masks[k] + x0;
        if (raised_masks.size() == 4)
            add_masks<4>(here.data(), weights.data(), masks.data(), count);
        else
            add_masks<3>(here.data(), weights.data(), masks.data(), count);
        float* d = difference + x0;
        for (unsigned x = 0; x < count; ++x) {
            const float seen = safe_power(d[x], mask_exponent_, epsilon_, mask_offset_) / masks[x];
            d[x] = greatest_ * seen / (greatest_ + seen);
        }
    }
}
