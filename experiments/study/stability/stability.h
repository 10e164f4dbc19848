#pragma once
#include "experiments/study/stability/stability_case.h"

#include <span>

/// Names of what is run; empty: all.
struct StabilitySelection {
    std::filesystem::path table;          ///< table of cases
    std::vector<std::string> cases;       ///< names, families or groups of cases
    std::vector<std::string> techniques;  ///< as all_points() takes them
};

/// Where scenes and references are.
struct StabilityFolders {
    std::vector<std::filesystem::path> search_path;  ///< of scenes
    std::filesystem::path cache;                     ///< of references
};

/// The chosen cases of the table. Fails with Error on unknown names.
std::vector<StabilityCase> chosen_cases(const StabilitySelection& selection);

/// Runs every chosen technique, and the path tracer, through every chosen case; each device has its own thread. `done`
/// gets the rows of a finished case and the share of the work done, one call at a time. Returns all rows in the order
/// of the table. Fails with Error on unknown names.
std::vector<StabilityRow> run_stability(
    std::span<Device* const> devices, const StabilitySelection& selection, const StabilityFolders& folders,
    const std::function<void(const std::vector<StabilityRow>& rows_of_case, double share)>& done);
