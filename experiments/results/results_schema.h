#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The columns of parameters.csv before those of the parameters.
inline constexpr const char* names_of_points[] = {"technique", "point", "label", "group", "preset"};

/// A parameter that some techniques of a study have, as a column of parameters.csv.
struct ParameterColumn {
    std::string name, type, unit, doc;
};

/// A Data Package (https://specs.frictionlessdata.io/data-package) of a results folder's CSV files: type, unit and
/// meaning of each column, and of the values of columns that hold certain names. `parameters`: the study's.
nlohmann::json results_schema(const std::vector<ParameterColumn>& parameters);
