#include "experiments/results/cells/study_rows.h"

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

MeasuredRows rows_of(const std::vector<Cell>& cells) {
    MeasuredRows all;
    const auto append = [](auto& rows, const auto& some) { rows.insert(rows.end(), some.begin(), some.end()); };
    for (const Cell& cell : cells) {
        for_each_list([&](const auto& list) { append(all.*list.member, cell.*list.member); });
        append(all.reference_noise, cell.reference_noise);
    }
    mark_representative_rows(all.results);
    return all;
}
