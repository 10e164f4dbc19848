#pragma once
#include "experiments/study/run.h"

/// Fills settings.out with the cells of `folders`, which hold the same study, and makes tables and report of all cells
/// there. Nothing is rendered, and the devices that made the cells are not needed. `folders` may be settings.out alone.
///
/// Where several folders have a cell of times, the least disturbed counts; for other cells the folder named first.
/// Returns the number of missing cells, including all cells of a shot whose references are missing. Fails with Error if
/// a folder holds another study, or if two folders measured against different pixels of the truth.
size_t merge_study(const Config& config, const RunSettings& settings,
                   const std::vector<std::filesystem::path>& folders);
