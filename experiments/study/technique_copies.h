#pragma once
#include "experiments/study/config/config.h"

/// Writes what took part of the folder of each technique that a folder declares to techniques/NAME/ of the results, so
/// that the study can be repeated: technique.json, its shaders and what they include of it.
void write_technique_copies(const std::filesystem::path& results, const std::vector<PointConfig>& techniques);
