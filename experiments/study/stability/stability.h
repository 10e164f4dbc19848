#pragma once
#include "experiments/study/stability/stability_case.h"

#include <span>

/// What is run, by names; empty: all.
struct StabilitySelection {
    std::filesystem::path table;          ///< of cases
    std::vector<std::string> cases;       ///< names, families or groups of its cases
    std::vector<std::string> techniques;  ///< as all_points() takes them
};

/// Where scenes and references are.
struct StabilityFolders {
    std::vector<std::filesystem::path> search_path;  ///< of scenes
    std::filesystem::path cache;                     ///< of references
};

/// The chosen cases of the table. Fails with Error on unknown names.
std::vector<StabilityCase> chosen_cases(const StabilitySelection& selection);

/// Runs every chosen technique through every chosen case, and the path tracer with them; each device in a thread of its
/// own. `done` gets the rows of a case once it has them all, with the share of the work that is behind it; one call at
/// a time. Returns all rows in the order of the table. Fails with Error on unknown names.
std::vector<StabilityRow> run_stability(
    std::span<Device* const> devices, const StabilitySelection& selection, const StabilityFolders& folders,
    const std::function<void(const std::vector<StabilityRow>& rows_of_case, double share)>& done);
