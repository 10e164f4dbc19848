#include "experiments/results/verdicts/study_results.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/json_types.h"
#include "core/path_inside.h"
#include "experiments/results/evaluation.h"

namespace {

using nlohmann::json;

/// manifest.json as far as commands read it.
const json& manifest_types() {
    static const json types = json::parse(R"({
        "title?": "text", "is_complete?": "true or false", "study?": {"name?": "text", "config?": "text"},
        "primary?": {"metric?": "text", "mask?": "text", "target?": "text", "margin?": "number"},
        "written?": {"ssrlab?": "object"}, "config?": "object",
        "techniques?": [{"technique?": "text", "point?": "text", "label?": "text", "group?": "text",
                       "baseline?": "true or false", "uses_scene_data?": "true or false", "parameters?": "object"}],
        "shots?": [{"shot?": "text", "scene?": "text", "asset?": "text", "label?": "text", "group?": "text",
                    "exposure_ev?": "number", "references?": [{"hash?": "text"}],
                    "truth_ladder?": [{"rung?": "text", "target?": "text", "metric?": "text", "mask?": "text"}]}],
        "images?": [{"shot?": "text", "technique?": "text", "point?": "text", "kind?": "text", "target?": "text"}],
        "provenance?": [{"host?": {"name?": "text", "cpu?": "text"}, "device?": {"name?": "text"}, "ssrlab?": "object"}],
        "clock?": {"load?": [{"shot?": "text", "host?": {"name?": "text", "cpu?": "text"}}],
                   "proofs?": [{"verdict?": "text", "shots?": ["text"]}],
                   "aa_floors?": "object", "aa_pairs?": [{"shot?": "text"}]}
    })");
    return types;
}

}  // namespace

void require_manifest(const json& manifest, const std::filesystem::path& file) {
    require_type(manifest, manifest_types(), file.string(), OtherMembers::allowed);
}

StudyResults read_study_results(const std::filesystem::path& folder) {
    const auto file = [&](const char* name) { return path_inside(folder, name); };
    if (!std::filesystem::exists(file("manifest.json")))
        fail(folder.string(), " is no results folder: it has no manifest.json; `ssrlab run` makes one");
    StudyResults tables;
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
    if (std::filesystem::exists(file("estimates.csv")))
        tables.estimates = read_rows<EstimateRow>(file("estimates.csv"));
    return tables;
}
