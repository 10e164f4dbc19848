#include "experiments/results/cells/study_rows.h"

#include "core/path_inside.h"
#include "experiments/results/cells/estimate_table.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

namespace {

unsigned frame_number(const ResultRow& row) { return unsigned(std::strtoul(row.frame.c_str(), nullptr, 10)); }

}  // namespace

void mark_representative_rows(std::span<ResultRow> rows) {
    using Quantity = std::tuple<std::string, std::string, std::string, std::string>;
    const auto quantity_of = [](const ResultRow& r) { return Quantity{r.shot, r.target, r.metric, r.mask}; };
    std::set<Quantity> known_over_frames;
    std::map<std::string, unsigned> last;
    for (const ResultRow& r : rows) {
        if (r.frame == over_frames)
            known_over_frames.insert(quantity_of(r));
        else
            last[r.shot] = std::max(last[r.shot], frame_number(r));
    }
    for (ResultRow& r : rows)
        r.represents_shot =
            r.frame == over_frames || (frame_number(r) == last[r.shot] && !known_over_frames.contains(quantity_of(r)));
}

StudyRows rows_of(const std::vector<Cell>& cells) {
    StudyRows rows;
    const auto append = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
    for (const Cell& cell : cells) {
        append(rows.results, cell.rows), append(rows.splits, cell.splits), append(rows.times, cell.times);
        append(rows.hits, cell.hits), append(rows.costs, cell.costs);
        append(rows.compiled, cell.compiled), append(rows.estimates, cell.estimates);
        append(rows.reference_noise, cell.reference_noise);
    }
    mark_representative_rows(rows.results);
    return rows;
}

void write_tables(const std::filesystem::path& folder, const StudyRows& rows) {
    write_rows(folder / "results.csv", rows.results);
    write_rows(folder / "splits.csv", rows.splits);
    write_rows(folder / "times.csv", rows.times);
    const auto write_if_any = [&](const char* file, const auto& some) {
        if (some.empty())
            std::filesystem::remove(path_inside(folder, file));  // of an earlier version of the study
        else
            write_rows(path_inside(folder, file), some);
    };
    write_if_any("hits.csv", rows.hits), write_if_any("costs.csv", rows.costs);
    write_if_any("compiled.csv", rows.compiled), write_if_any("estimates.csv", estimate_table(rows.estimates));
}
