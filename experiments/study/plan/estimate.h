#pragma once
#include "core/gpu/device.h"
#include "experiments/study/plan/study_plan.h"
#include "experiments/study/run.h"

#include <map>
#include <optional>
#include <string>

/// Expected time and memory of a cell on this machine.
struct CellEstimate {
    double seconds = 0;            ///< while other programs take as much of the machine as they take now
    double processor_seconds = 0;  ///< of all processors together; hardly depends on other programs
    double memory_mib = 0;         ///< peak of the process that does the cell
};

struct StudyEstimate {
    std::map<std::string, CellEstimate> cells;  ///< by name
    std::optional<double> load_of_others;  ///< share of all processors that other programs took meanwhile, if reported
};

/// Estimates a study's cells, after calibrate(). References count as stopping at their limit of samples or seconds;
/// without a limit, at the default number of samples.
StudyEstimate estimate_study(Device& device, const Config& config, const StudyPlan& plan, const RunSettings& settings);
