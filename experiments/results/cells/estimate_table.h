#pragma once
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/cells/cell.h"

/// A row of estimates.csv: an estimate, and the bounds that the model's range leaves for the time (model_range).
struct EstimateTableRow : EstimateRow {
    std::optional<double> model_low, model_high;

    static constexpr auto columns() {
        return std::tuple_cat(EstimateRow::columns(), MEMBER_COLUMNS(EstimateTableRow, model_low, model_high));
    }
};

/// Rows in the form of their table's file.
template <class Row>
std::vector<Row> rows_in_file(const std::vector<Row>& rows) {
    return rows;
}
inline std::vector<EstimateTableRow> rows_in_file(const std::vector<EstimateRow>& rows) {
    std::vector<EstimateTableRow> table;
    for (const EstimateRow& row : rows) {
        EstimateTableRow& made = table.emplace_back(EstimateTableRow{row, std::nullopt, std::nullopt});
        if (row.low) made.model_low = *row.low * model_range.low;
        if (row.high) made.model_high = *row.high * model_range.high;
    }
    return table;
}
