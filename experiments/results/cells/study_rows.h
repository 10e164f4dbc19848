#pragma once
#include "experiments/results/cells/cell.h"

#include <span>
#include <vector>

/// The rows of all cells, with mark_representative_rows() done.
MeasuredRows rows_of(const std::vector<Cell>& cells);

/// Decides which frames represent a shot in tables, effects, report and figures: of each quantity (target, metric,
/// mask) the rows over its frames where a point has such, else those of its last frame.
void mark_representative_rows(std::span<ResultRow> rows);
