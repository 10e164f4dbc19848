#pragma once
#include "experiments/study/stability/case_run.h"

/// A change of a G-buffer by one step of one input in every pixel, up or down by a fixed draw. Steps:
///
/// - depth: one code of its format (d32f: one unit in the last place), as a share of the distance along the view
/// - normal: one step of an octahedral code of 2 x 16 bits, 2^-15 rad
/// - lit colour: half of a half-float's last place, 2^-11
struct Perturbation {
    std::optional<double> StabilityRow::*median;  ///< column of the median amplification of this input, ...
    std::optional<double> StabilityRow::*p999;    ///< ... and of its 99.9 % quantile over pixels
    std::function<void(HostGBuffer&)> apply;
    double relative_step = 0;  ///< relative change of the input; 0: it differs by pixel
};
const std::vector<Perturbation>& perturbations();

/// Measures how much more the output changes than the perturbed input, over the pixels that reflect: |change of the
/// specular radiance| / its mean magnitude / relative change of the input.
void measure_amplification(StabilityRow& row, const Perturbation& perturbation, const CaseFrames& frames,
                           const CaseResult& run, const CaseResult& perturbed);

/// The quantile `share`, in [0, 1], of `values` (at least one); reorders `values`.
double quantile(std::vector<double>& values, double share);
