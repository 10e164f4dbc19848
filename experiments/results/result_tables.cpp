#include "experiments/results/result_tables.h"

#include "core/path_inside.h"
#include "experiments/results/evaluation.h"

ResultTables read_result_tables(const std::filesystem::path& folder, const nlohmann::json& manifest) {
    require_evaluation(folder, manifest);
    const auto file = [&](const char* name) { return path_inside(folder, name); };
    ResultTables tables{.errors = read_rows<MetricSummary>(file("summary.csv")),
                        .splits = {},
                        .hits = {},
                        .costs = {},
                        .compiled = {},
                        .estimates = {},
                        .effects = {},
                        .time_effects = {},
                        .times = read_rows<TimeSummary>(file("time_summary.csv")),
                        .over_scenes = read_rows<OverScenesRow>(file("over_scenes.csv")),
                        .stability = read_stability_results(folder)};
    const auto has = [&](const char* name) { return std::filesystem::exists(file(name)); };
    if (has("splits.csv")) tables.splits = read_rows<SplitRow>(file("splits.csv"));
    if (has("hits.csv")) tables.hits = read_rows<HitRow>(file("hits.csv"));
    if (has("costs.csv")) tables.costs = read_rows<CostRow>(file("costs.csv"));
    if (has("compiled.csv")) tables.compiled = read_rows<CompiledRow>(file("compiled.csv"));
    if (has("estimates.csv")) tables.estimates = read_rows<EstimateRow>(file("estimates.csv"));
    if (has("effects.csv")) tables.effects = read_rows<EffectRow>(file("effects.csv"));
    if (has("time_effects.csv")) tables.time_effects = read_rows<TimeEffectRow>(file("time_effects.csv"));
    return tables;
}
