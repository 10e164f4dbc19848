#pragma once
#include "experiments/config/config.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// What the columns of a results folder's CSV files are: a Data Package
/// (https://specs.frictionlessdata.io/data-package), with type, unit and meaning of each. `variants`: the study's,
/// whose parameters parameters.csv has.
nlohmann::json results_schema(const std::vector<VariantConfig>& variants);

/// Writes parameters.csv, a row for each point with its label, group, preset and the values of all its parameters, and
/// schema.json.
void write_parameters(const std::filesystem::path& folder, const std::vector<VariantConfig>& variants);
