#pragma once
#include "core/gpu/device.h"
#include "experiments/study/plan/study_plan.h"
#include "experiments/study/run.h"

#include <map>
#include <string>

/// What a cell will take on this machine while nothing else runs.
struct CellEstimate {
    double seconds = 0;
    double memory_mib = 0;  ///< of the process that does it, at most
};

/// By the names of cells. Calibrated by rendering small images of the study's first shot with two points of each
/// technique and preset: some ten seconds, and longer where a study has many presets. References are taken to stop at
/// their limit of samples or seconds; where they have neither, at the default number of samples.
std::map<std::string, CellEstimate> estimate_cells(Device& device, const Config& config, const StudyPlan& plan,
                                                   const RunSettings& settings);
