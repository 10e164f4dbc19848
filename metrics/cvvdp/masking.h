#pragma once
#include "metrics/cvvdp/calibration.h"

#include <span>
#include <vector>

/// How contrasts that both images have hide their differences, as loops over rows of pixels. All numbers are float32
/// of a calibration's.
class Masking {
public:
    explicit Masking(const CvvdpCalibration& calibration);

    /// The mask is blurred where an image has more pixels than this in both directions.
    static constexpr unsigned blur_radius = 6;

    /// Replaces test and reference by |test - reference| and the lesser of both absolutes.
    static void split(float* test_then_difference, float* reference_then_mask, unsigned width);

    /// out = the row of a mask blurred; pixels beyond its ends mirror it without doubling the edge. width >
    /// blur_radius.
    void blur_row(const float* mask, float* out, unsigned width, std::vector<float>& scratch) const;

    /// out = the middle of 2 blur_radius + 1 rows blurred, times the gain of masks.
    void blur_column(std::span<const float* const> rows, float* out, unsigned width) const;

    /// out = mask times the gain of masks.
    void scale(const float* mask, float* out, unsigned width) const;

    /// Replaces masks by the power with which `channel` masks.
    void raise(unsigned channel, float* mask, unsigned width) const;

    /// Replaces differences in `channel` by those that are seen under the raised masks of all channels, at most
    /// 10^log10_greatest_difference.
    void apply(unsigned channel, std::span<const float* const> raised_masks, float* difference, unsigned width) const;

private:
    float epsilon_, gain_, greatest_, mask_exponent_, mask_offset_;
    PerCvvdpChannel<float> exponents_, offsets_;
    PerCvvdpChannel<PerCvvdpChannel<float>> cross_channels_;
    std::array<float, blur_radius + 1> taps_;  ///< of distances 0 to blur_radius
};
