#pragma once
#include "core/gpu/device.h"
#include "experiments/study/plan/study_plan.h"
#include "experiments/study/run.h"

#include <map>
#include <string>

/// Expected time and memory of a cell on this machine while nothing else runs.
struct CellEstimate {
    double seconds = 0;
    double memory_mib = 0;  ///< peak of the process that does the cell
};

/// Estimates by name of cell. They are calibrated by rendering small images of the study's first shot with two points
/// of each technique and preset: some ten seconds, longer for many presets. References count as stopping at their limit
/// of samples or seconds; without a limit, at the default number of samples.
std::map<std::string, CellEstimate> estimate_cells(Device& device, const Config& config, const StudyPlan& plan,
                                                   const RunSettings& settings);
