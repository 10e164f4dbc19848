#pragma once
#include "experiments/stability/stability_rows.h"

#include <span>

/// Which cases and techniques: names, or groups of cases; empty: all. A technique's name may have a preset behind a
/// colon.
struct StabilitySelection {
    std::vector<std::string> cases, variants;
};

/// The table's cases with these names, or of these groups, or all. Fails with Error on unknown ones.
std::vector<StabilityCase> chosen_cases(const std::filesystem::path& table, const std::vector<std::string>& names);

/// The points of stability_points() with these names, or all. Fails with Error on unknown ones.
std::vector<StabilityPoint> chosen_points(const std::vector<std::string>& names);

/// Runs every chosen technique through every chosen case, and the path tracer with them; each device in a thread of its
/// own. `done` gets the rows of a case once it has them all, with the share of the work that is behind it; one call at
/// a time. Returns all rows in the order of the table. Fails with Error on unknown names.
std::vector<StabilityRow> run_stability(
    std::span<Device* const> devices, const std::filesystem::path& table, const StabilitySelection& selection,
    const std::vector<std::filesystem::path>& search_path,
    const std::function<void(const std::vector<StabilityRow>& rows_of_case, double share)>& done);
