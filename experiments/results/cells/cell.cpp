#include "experiments/results/cells/cell.h"

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeedPairs, variance, bias_squared)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReferenceNoise, shot, frame, technique, point, target, metric, mask, sums, growth)

namespace {

template <class Row>
nlohmann::json rows_json(const std::vector<Row>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& row : rows) list.push_back(row_json(row));
    return list;
}

template <class Row>
std::vector<Row> rows_from_json(const nlohmann::json& list) {
    std::vector<Row> rows;
    for (const nlohmann::json& row : list) rows.push_back(row_from_json<Row>(row));
    return rows;
}

/// With what splits.csv does not have.
nlohmann::json splits_json(const std::vector<SplitRow>& splits) {
    nlohmann::json list = rows_json(splits);
    for (size_t i = 0; i < splits.size(); ++i) {
        const SplitRow& s = splits[i];
        list[i].update({{"seed_numbers", s.seed_numbers},
                        {"pairs", s.pairs},
                        {"reference_noise", s.reference_noise},
                        {"lit_noise", column_json(s.lit_noise)},
                        {"lit_half_width", column_json(s.lit_half_width)}});
    }
    return list;
}

std::vector<SplitRow> splits_from_json(const nlohmann::json& list) {
    std::vector<SplitRow> splits = rows_from_json<SplitRow>(list);
    for (size_t i = 0; i < splits.size(); ++i) {
        SplitRow& s = splits[i];
        list[i].at("seed_numbers").get_to(s.seed_numbers), list[i].at("pairs").get_to(s.pairs);
        list[i].at("reference_noise").get_to(s.reference_noise);
        read_json(list[i].at("lit_noise"), s.lit_noise), read_json(list[i].at("lit_half_width"), s.lit_half_width);
    }
    return splits;
}

}  // namespace

void to_json(nlohmann::json& json, const Cell& cell) {
    json = {{"rows", rows_json(cell.rows)},
            {"splits", splits_json(cell.splits)},
            {"reference_noise", cell.reference_noise},
            {"times", rows_json(cell.times)},
            {"hits", rows_json(cell.hits)},
            {"costs", rows_json(cell.costs)},
            {"compiled", rows_json(cell.compiled)},
            {"estimates", rows_json(cell.estimates)},
            {"images", cell.images},
            {"timing", cell.timing},
            {"notes", cell.notes},
            {"truth", cell.truth},
            {"shot", cell.shot},
            {"seconds", cell.seconds},
            {"provenance", cell.provenance}};
}

void from_json(const nlohmann::json& json, Cell& cell) {
    cell.rows = rows_from_json<ResultRow>(json.at("rows"));
    cell.splits = splits_from_json(json.at("splits"));
    cell.times = rows_from_json<TimeRow>(json.at("times"));
    cell.hits = rows_from_json<HitRow>(json.at("hits"));
    cell.costs = rows_from_json<CostRow>(json.at("costs"));
    cell.compiled = rows_from_json<CompiledRow>(json.at("compiled"));
    cell.estimates = rows_from_json<EstimateRow>(json.at("estimates"));
    json.at("reference_noise").get_to(cell.reference_noise);
    cell.images = json.at("images"), cell.timing = json.at("timing");
    json.at("notes").get_to(cell.notes), json.at("truth").get_to(cell.truth);
    json.at("seconds").get_to(cell.seconds);
    cell.shot = json.at("shot"), cell.provenance = json.at("provenance");
}
