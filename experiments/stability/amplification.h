#pragma once
#include "experiments/stability/case_run.h"

/// How much more the output changes than an input of which the last digit is changed: |change of the specular radiance|
/// over its mean magnitude, divided by the relative change of the input, over the pixels that reflect.
struct Amplification {
    std::string input;  ///< "depth", "normal", "lit"
    double median = 0, p999 = 0;
};

/// G-buffers in which every pixel's value of one input moves by one step, up or down by a fixed draw:
/// depth by one code of its format (d32f: one unit in the last place), as a share of the distance along the view;
/// the normal by one step of an octahedral code of 2 x 16 bits, 2^-15 (rad); the lit colour by half of a half-float's
/// last place, 2^-11.
struct Perturbation {
    std::string input;
    std::function<void(HostGBuffer&)> apply;
    double relative_step = 0;  ///< of the input; 0: it differs by pixel, see relative_step_of()
};
std::vector<Perturbation> perturbations();

/// By pixel.
double relative_step_of(const Perturbation& perturbation, const HostGBuffer& gbuffer, size_t pixel);

Amplification amplification(const Perturbation& perturbation, const CaseFrames& frames, const CaseResult& run,
                            const CaseResult& perturbed);

/// The value that the share `share`, in [0, 1], of `values` lies below; changes their order. At least one value.
double quantile(std::vector<double>& values, double share);
