#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>

/// Writes schema.json (results_schema.h) and parameters.csv: one row for each point, with label, group, preset and all
/// parameter values.
void write_parameters(const std::filesystem::path& folder, const std::vector<PointConfig>& techniques);
