#include "experiments/evaluation/study_tables.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/evaluation/evaluation.h"

StudyTables read_study_tables(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "manifest.json";
    if (!std::filesystem::exists(file))
        fail(folder.string(), " is no results folder: it has no manifest.json; `ssrlab run` makes one");
    StudyTables tables;
    tables.manifest = parse_json(read_text(file), file.string());
    require_evaluation(folder, tables.manifest);
    tables.errors = read_rows<MetricSummary>(folder / "summary.csv");
    tables.seeds = read_rows<ResultRow>(folder / "results.csv");
    tables.times = read_rows<TimeSummary>(folder / "time_summary.csv");
    tables.rounds = read_rows<TimeRow>(folder / "times.csv");
    tables.effects = read_rows<EffectRow>(folder / "effects.csv");
    tables.time_effects = read_rows<TimeEffectRow>(folder / "time_effects.csv");
    if (std::filesystem::exists(folder / "costs.csv")) tables.costs = read_rows<CostRow>(folder / "costs.csv");
    return tables;
}
