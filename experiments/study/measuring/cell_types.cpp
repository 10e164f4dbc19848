// What a cell's file holds: types and lengths, so that one of a stranger is refused where it is read.
#include "core/error.h"
#include "core/json_types.h"
#include "experiments/results/cells/cell.h"
#include "metrics/extrapolation.h"
#include "metrics/video_jod.h"

#include <algorithm>

namespace {

using nlohmann::json;

void add_type(json& types, const std::string& name, const std::string&) { types[name] = "text"; }
void add_type(json& types, const std::string& name, bool) { types[name] = "true or false"; }
void add_type(json& types, const std::string& name, unsigned) { types[name] = "count"; }
void add_type(json& types, const std::string& name, size_t) { types[name] = "size"; }
void add_type(json& types, const std::string& name, double) { types[name] = "number"; }
void add_type(json& types, const std::string& name, const std::optional<double>&) { types[name + "??"] = "number"; }

/// Of a row's columns.
template <class Row>
json row_types() {
    json types;
    const Row row{};
    for_each_column<Row>([&](const auto& column) { add_type(types, column.name, row.*column.member); });
    return types;
}

json cell_types() {
    json types = json::parse(R"({
        "reference_noise": [{"shot": "text", "frame": "text", "technique": "text", "point": "text", "target": "text",
                             "metric": "text", "mask": "text", "sums": ["number"], "growth": ["number"]}],
        "images": [{"shot": "text", "frame": "count", "technique": "text", "point??": "text", "seed??": "count",
                    "kind": "text", "target": "text", "epsilon??": "number",
                    "exr": "text", "exr_hash": "text", "png": "text", "png_hash": "text"}],
        "timing??": {"shot": "text", "saved_ms": {"*": "number"},
                    "aa_pairs": [{"shot": "text", "technique": "text", "point": "text", "first_ms": "number",
                                  "second_ms": "number", "floor": "number"}],
                    "savings": [{"shot": "text", "technique": "text", "point": "text", "complete_ms": "number",
                                 "share": "number", "low": "number", "high": "number"}],
                    "load": {"frames": "count", "disturbed_frames": "count", "left_out_frames": "count",
                             "largest_foreign_load??": "number", "largest_stolen_share": "number"},
                    "clock": {"method": "text", "empty_submit_ms": "number", "verdict": "text",
                              "checks": [{"stage_kind": "text", "expected": ["number"], "measured_ms": ["number"],
                                          "ratio": ["number"], "foreign_load??": "number", "attempts": "count",
                                          "verdict": "text"}]}},
        "notes": ["text"],
        "truth": "text",
        "seconds": "number",
        "shot??": {"needs??": [{"fact": "text", "value": "text", "why": "text"}], "lit??": "text", "warnings??": ["text"],
                  "flip_exposures??": ["number"], "gbuffer_non_finite??": {"*": "size"},
                  "truth_ladder??": [{"rung": "text", "target": "text", "metric": "text", "formula": "text",
                                     "mask": "text", "value??": "number", "low??": "number", "high??": "number",
                                     "pixels": "size"}]},
        "provenance": {"what": "text", "started": "text", "finished": "text",
                       "ssrlab": {"version": "text", "commit": "text", "dirty": "true or false", "code": "text",
                                  "compiler": "text", "build": "text", "estimators": "count"},
                       "device": {"name": "text", "driver": "text", "api": "text", "type": "text",
                                  "memory_mib": "number"},
                       "host": {"name": "text", "cpu": "text", "cores": "count", "memory_gib": "number",
                                "kernel": "text"}}})");
    const json reference = json::parse(R"({
        "frame": "count", "hash": "text", "lit_only??": "true or false", "samples_median": "number", "passes": "text", "seconds": "number",
        "rays": "number", "max_depth": "count", "target_relative_error": "number",
        "relative_error": {"median??": "number", "p95??": "number", "mean??": "number"}, "reached_share??": "number",
        "noise??": {"target": "text", "mask": "text", "pixels": "size", "noisiest_share": "number", "carriers": "number",
                    "by_roughness": [{"from": "number", "below": "number", "pixel_share": "number",
                                      "variance_share": "number"}]},
        "non_finite_samples": "size", "light_cut??": "number", "warnings": ["text"], "from_cache": "true or false",
        "halves??": {"*": {"mean_z_squared??": "number", "low??": "number", "high??": "number", "correlation??": "number",
                          "most_correlation??": "number"}}})");
    types["shot??"]["reference??"] = reference, types["shot??"]["references??"] = json::array({reference});
    for_each_list([&]<class Row>(const Column<MeasuredRows, std::vector<Row>>& list) {
        types[list.name] = json::array({row_types<Row>()});
    });
    types["splits"][0].update(json::parse(R"({
        "seed_numbers": ["count"], "pairs": {"variance": ["number"], "bias_squared": ["number"]},
        "reference_noise": ["number"], "lit_noise??": "number", "lit_half_width??": "number"})"));
    return types;
}

void require_bands(const std::string& what, const json& list) {
    constexpr size_t most_bands = 32;  // of images with sides below 2^32 pixels
    if (list.empty() || list.size() > most_bands)
        fail(what, " has ", list.size(), " values and needs 1 to ", most_bands, ", one for each band of frequencies");
}

/// Arrays that are gone through side by side.
void check_lengths(const json& cell, const std::string& where) {
    const auto check_length = [&](const std::string& what, const json& list, std::initializer_list<size_t> allowed) {
        if (!std::ranges::count(allowed, list.size()))
            fail(where, ": ", what, " has ", list.size(), " values and needs ", *allowed.begin());
    };
    constexpr size_t growth_values = growth_groups * (size_t(GrowthColumn::swapped) + 1);
    for (size_t i = 0; i < cell["reference_noise"].size(); ++i) {
        const json& noise = cell["reference_noise"][i];
        const std::string at = "reference_noise[" + std::to_string(i) + "]: ";
        check_length(at + "growth", noise["growth"], {growth_values, 0});
        if (noise["metric"] == video_jod_name)
            require_bands(where + ": " + at + "sums", noise["sums"]);
        else
            check_length(at + "sums", noise["sums"], {noise["growth"].empty() ? noise_groups : 0});
    }
    for (size_t i = 0; i < cell["splits"].size(); ++i) {
        const json& split = cell["splits"][i];
        const std::string at = "splits[" + std::to_string(i) + "]: ";
        const size_t seeds = std::max<size_t>(split["seed_numbers"].size(), 2);  // a single one is paired with itself
        for (const char* part : {"variance", "bias_squared"})
            check_length(at + "pairs: " + part, split["pairs"][part], {seeds * (seeds - 1) / 2});
        check_length(at + "reference_noise", split["reference_noise"], {noise_groups, 0});
    }
}

}  // namespace

Cell read_cell(const json& json, const std::string& where) {
    static const nlohmann::json types = cell_types();
    require_type(json, types, where);
    check_lengths(json, where);
    return json.get<Cell>();
}
