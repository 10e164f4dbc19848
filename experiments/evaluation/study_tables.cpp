#include "experiments/evaluation/study_tables.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/evaluation/evaluation.h"

namespace {

using nlohmann::json;

/// manifest.json as far as commands read it: each member, where there is one, is of the kind that stands here.
const json& manifest_sample() {
    static const json sample = json::parse(R"({
        "title": "", "is_complete": false, "primary": {"metric": "", "mask": "", "target": ""},
        "written": {"ssrlab": {}}, "config": {},
        "variants": [{"variant": "", "point": "", "label": "", "group": "", "baseline": false, "uses_scene_data": false,
                      "parameters": {}}],
        "shots": [{"shot": "", "scene": "", "asset": "", "label": "", "group": "", "exposure_ev": 0,
                   "references": [{"hash": ""}],
                   "truth_ladder": [{"rung": "", "target": "", "metric": "", "mask": ""}]}],
        "images": [{"shot": "", "variant": "", "point": "", "kind": "", "target": ""}],
        "provenance": [{"host": {"name": "", "cpu": ""}, "device": {"name": ""}, "ssrlab": {}}],
        "clock": {"load": [{"shot": "", "host": {"name": "", "cpu": ""}}], "proofs": [{"verdict": "", "shots": [""]}],
                  "aa_floors": {}, "aa_pairs": [{"shot": ""}]}
    })");
    return sample;
}

void require_like(const json& value, const json& sample, const std::string& where) {
    const bool is_like = sample.is_number() ? value.is_number() : value.type() == sample.type();
    const char* const kind = sample.is_number()    ? "a number"
                             : sample.is_string()  ? "a text"
                             : sample.is_boolean() ? "true or false"
                             : sample.is_array()   ? "an array"
                                                   : "an object";
    if (!is_like) fail(where, " must be ", kind, ", not ", shown(value));
    if (sample.is_array())
        for (size_t i = 0; i < value.size(); ++i)
            require_like(value[i], sample.front(), where + "[" + std::to_string(i) + "]");
    if (sample.is_object())
        for (const auto& [key, member] : sample.items())
            if (value.contains(key)) require_like(value[key], member, where + ": " + key);
}

}  // namespace

void require_manifest(const json& manifest, const std::filesystem::path& file) {
    require_like(manifest, manifest_sample(), file.string());
}

StudyTables read_study_tables(const std::filesystem::path& folder) {
    const auto file = [&](const char* name) { return path_inside(folder, name); };
    if (!std::filesystem::exists(file("manifest.json")))
        fail(folder.string(), " is no results folder: it has no manifest.json; `ssrlab run` makes one");
    StudyTables tables;
    tables.manifest = parse_json(read_text(file("manifest.json")), file("manifest.json").string());
    require_manifest(tables.manifest, file("manifest.json"));
    require_evaluation(folder, tables.manifest);
    tables.errors = read_rows<MetricSummary>(file("summary.csv"));
    tables.seeds = read_rows<ResultRow>(file("results.csv"));
    tables.times = read_rows<TimeSummary>(file("time_summary.csv"));
    tables.rounds = read_rows<TimeRow>(file("times.csv"));
    tables.effects = read_rows<EffectRow>(file("effects.csv"));
    tables.time_effects = read_rows<TimeEffectRow>(file("time_effects.csv"));
    if (std::filesystem::exists(file("costs.csv"))) tables.costs = read_rows<CostRow>(file("costs.csv"));
    return tables;
}
