#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>

/// Writes parameters.csv, a row for each point with its label, group, preset and the values of all its parameters, and
/// schema.json (results_schema.h).
void write_parameters(const std::filesystem::path& folder, const std::vector<PointConfig>& techniques);
