#pragma once
#include "experiments/study/stability/case_run.h"

/// The change of a G-buffer in which every pixel's value of one input moves by one step, up or down by a fixed draw:
/// depth by one code of its format (d32f: one unit in the last place), as a share of the distance along the view;
/// the normal by one step of an octahedral code of 2 x 16 bits, 2^-15 (rad); the lit colour by half of a half-float's
/// last place, 2^-11.
struct Perturbation {
    std::optional<double> StabilityRow::*median;  ///< of the amplification of this input, ...
    std::optional<double> StabilityRow::*p999;    ///< ... and what 99.9 % of its pixels lie below
    std::function<void(HostGBuffer&)> apply;
    double relative_step = 0;  ///< of the input; 0: it differs by pixel
};
const std::vector<Perturbation>& perturbations();

/// How much more the output changes than the input of which the last digit is changed: |change of the specular
/// radiance| over its mean magnitude, divided by the relative change of the input, over the pixels that reflect.
void measure_amplification(StabilityRow& row, const Perturbation& perturbation, const CaseFrames& frames,
                           const CaseResult& run, const CaseResult& perturbed);

/// The value that the share `share`, in [0, 1], of `values` lies below; changes their order. At least one value.
double quantile(std::vector<double>& values, double share);
