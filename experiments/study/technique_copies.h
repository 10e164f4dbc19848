#pragma once
#include "experiments/study/config/config.h"

/// Copies the used files of each technique that a folder declares to techniques/NAME/ of the results, so that the study
/// can be repeated: technique.json, its shaders, and what they include from the folder.
void write_technique_copies(const std::filesystem::path& results, const std::vector<PointConfig>& techniques);
