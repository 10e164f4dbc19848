#pragma once
#include "experiments/study/run.h"

/// Fills settings.out with the cells that folders of the same study hold, and makes tables and report of all that
/// are there; nothing is rendered, and the device that made them need not be here. `folders` may be settings.out itself
/// alone. Of cells that several have (times, on several machines) the least disturbed counts, else that of the folder
/// named first. Returns how many cells are missing: cells of a shot whose references are missing count as missing, too.
/// Fails with Error if a folder holds another study, or if what was measured in two folders was measured against other
/// pixels of the truth.
size_t merge_study(const Config& config, const RunSettings& settings,
                   const std::vector<std::filesystem::path>& folders);
