#pragma once
#include "experiments/results/cells/cell.h"

#include <span>
#include <vector>

/// The rows of all cells, with mark_representative_rows() done.
MeasuredRows rows_of(const std::vector<Cell>& cells);

/// Decides which frames represent a shot in tables, effects, report and figures. For each point and quantity (target,
/// metric, mask): the rows over its frames if there are any, else those of its last frame.
void mark_representative_rows(std::span<ResultRow> rows);
