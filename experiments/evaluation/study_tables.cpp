#include "experiments/evaluation/study_tables.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/evaluation/evaluation.h"

StudyTables read_study_tables(const std::filesystem::path& folder) {
    const auto file = [&](const char* name) { return path_inside(folder, name); };
    if (!std::filesystem::exists(file("manifest.json")))
        fail(folder.string(), " is no results folder: it has no manifest.json; `ssrlab run` makes one");
    StudyTables tables;
    tables.manifest = parse_json(read_text(file("manifest.json")), file("manifest.json").string());
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
