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
/// technique and preset: a few seconds, and longer where a study has many presets. What cannot be known before, as how
/// many samples a reference needs to reach an error, is taken at its limit.
std::map<std::string, CellEstimate> estimate_cells(Device& device, const Config& config, const StudyPlan& plan,
                                                   const RunSettings& settings);
