#pragma once
#include "experiments/cell.h"
#include "experiments/config.h"
#include "groundtruth/reference.h"
#include "metrics/masks.h"
#include "metrics/score.h"

#include <map>

/// What a variant's output is compared as.
struct CompositedImages {
    HostImage specular;    ///< (F0 A + F90 B) mix(fallback, radiance, confidence)
    HostImage incident;    ///< mix(fallback, radiance, confidence)
    HostImage confidence;  ///< one channel
};

/// What one frame's results are measured against: made once, used for every variant, point and seed.
struct FrameTruth {
    HostImage diffuse;                                ///< the truth's own, which `image` adds to every result; also the lit colour that variants read
    std::map<std::string, MetricReference> targets;   ///< by target name
    HostImage view_depth, normal, material_id, roughness, reflectance;
    FlipExposures flip_exposures;
    bool has_flip_exposures = false;  ///< a reference that is mostly black prescribes none
};

/// `roughness` one channel, `reflectance` F0 A + F90 B per pixel, both of the G-buffer.
FrameTruth frame_truth(const Reference& reference, HostImage roughness, HostImage reflectance, const Config& config, float exposure_ev);

/// Where there is no reference nothing is measured: the lit colour alone.
FrameTruth frame_without_truth(HostImage lit);

/// All targets x metrics x masks of one result. `row` holds what all rows share: shot, variant, point, seed.
std::vector<ResultRow> measure_result(const FrameTruth& truth, const CompositedImages& result, const Config& config, const ResultRow& row);

/// diffuse + specular.
HostImage composited_image(const FrameTruth& truth, const CompositedImages& result);
