#pragma once
#include "experiments/results/cells/cell.h"

#include <filesystem>
#include <span>
#include <vector>

/// The rows of a study's cells, in their order.
struct StudyRows {
    std::vector<ResultRow> results;
    std::vector<SplitRow> splits;
    std::vector<TimeRow> times;
    std::vector<HitRow> hits;
    std::vector<CostRow> costs;
    std::vector<CompiledRow> compiled;
    std::vector<EstimateRow> estimates;
    std::vector<ReferenceNoise> reference_noise;
};
/// With mark_representative_rows() done.
StudyRows rows_of(const std::vector<Cell>& cells);

/// Decides which frames represent a shot in tables, effects, report and figures: of each quantity (target, metric,
/// mask) the rows over its frames where a point has such, else those of its last frame.
void mark_representative_rows(std::span<ResultRow> rows);

/// Writes results.csv, splits.csv and times.csv, hits.csv if rays were judged, costs.csv if costs were counted, and
/// compiled.csv if compilers were asked, estimates.csv if both; the columns are explained in experiments/RESULTS.md.
void write_tables(const std::filesystem::path& folder, const StudyRows& rows);
