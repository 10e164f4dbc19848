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
void read_rows_json(const nlohmann::json& list, std::vector<Row>& rows) {
    for (const nlohmann::json& row : list) rows.push_back(row_from_json<Row>(row));
}

/// With what splits.csv does not have.
nlohmann::json rows_json(const std::vector<SplitRow>& splits) {
    nlohmann::json list = rows_json<SplitRow>(splits);
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

void read_rows_json(const nlohmann::json& list, std::vector<SplitRow>& splits) {
    read_rows_json<SplitRow>(list, splits);
    for (size_t i = 0; i < splits.size(); ++i) {
        SplitRow& s = splits[i];
        list[i].at("seed_numbers").get_to(s.seed_numbers), list[i].at("pairs").get_to(s.pairs);
        list[i].at("reference_noise").get_to(s.reference_noise);
        read_json(list[i].at("lit_noise"), s.lit_noise), read_json(list[i].at("lit_half_width"), s.lit_half_width);
    }
}

}  // namespace

void to_json(nlohmann::json& json, const Cell& cell) {
    json = {{"reference_noise", cell.reference_noise},
            {"images", cell.images},
            {"timing", cell.timing},
            {"notes", cell.notes},
            {"truth", cell.truth},
            {"shot", cell.shot},
            {"seconds", cell.seconds},
            {"provenance", cell.provenance}};
    for_each_list([&](const auto& list) { json[list.name] = rows_json(cell.*list.member); });
}

void from_json(const nlohmann::json& json, Cell& cell) {
    for_each_list([&](const auto& list) { read_rows_json(json.at(list.name), cell.*list.member); });
    json.at("reference_noise").get_to(cell.reference_noise);
    cell.images = json.at("images"), cell.timing = json.at("timing");
    json.at("notes").get_to(cell.notes), json.at("truth").get_to(cell.truth);
    json.at("seconds").get_to(cell.seconds);
    cell.shot = json.at("shot"), cell.provenance = json.at("provenance");
}
