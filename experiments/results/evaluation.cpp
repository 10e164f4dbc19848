#include "experiments/results/evaluation.h"

#include "core/error.h"
#include "core/files.h"
#include "core/path_inside.h"
#include "experiments/results/files/columns.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/pairs.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>

namespace {

template <class Row>
void require_table(const std::filesystem::path& file, const std::string& writer) {
    const std::string again =
        "; " + writer +
        ". Run `ssrlab run` or `ssrlab merge` again: finished cells are kept, and only the tables are made";
    if (!std::filesystem::exists(file)) fail(file.string(), " is missing", again);
    const std::string text = read_text(file), header = "," + text.substr(0, text.find_first_of("\r\n")) + ",";
    for_each_column<Row>([&](const auto& column) {
        if (header.find("," + std::string(column.name) + ",") == std::string::npos)
            fail(file.string(), " has no column '", column.name, "'", again);
    });
}

std::string writer_of(const nlohmann::json& manifest) {
    const nlohmann::json maker = manifest.value("written", nlohmann::json::object()).value("ssrlab", nlohmann::json());
    const std::string commit = maker.is_object() && maker.contains("commit") && maker["commit"].is_string()
                                   ? maker["commit"].get<std::string>()
                                   : "";
    return commit.empty() ? "the manifest does not say which version of ssrlab wrote the folder"
                          : "ssrlab of commit " + commit + " wrote the folder";
}

}  // namespace

void write_evaluation(const std::filesystem::path& folder, const StudyRows& rows, const nlohmann::json& manifest,
                      const std::vector<ComparedPoint>& compared, const PrimaryComparisons& primary) {
    const PointSet not_repeatable = points_not_repeatable(manifest);
    std::vector<MetricSummary> errors = summarise(rows.results, points_without_seeds(manifest), rows.reference_noise);
    // No interval holds how they scatter from run to run.
    for (MetricSummary& e : errors)
        if (not_repeatable.contains({e.technique, e.point})) e.holds_all_noise = false;
    set_standings(errors, paired_errors(rows.results, compared, not_repeatable, rows.reference_noise),
                  points_using_scene_data(manifest), primary.margin);
    std::map<std::string, double> floors;
    for (const TimeRow& t : rows.times)
        if (const auto floor = aa_floor(manifest, t.shot)) floors[t.shot] = *floor;
    const std::vector<TimeSummary> times = summarise(rows.times, floors);
    set_fronts(errors, times, rows.costs);
    write_rows(folder / "over_scenes.csv", errors_over_scenes(errors, manifest, primary.margin, compared));
    write_rows(folder / "time_summary.csv", times);

    std::vector<EffectRow> effects = paired_effects(rows.results, compared, not_repeatable, rows.reference_noise);
    std::ranges::move(split_effects(rows.splits, compared, not_repeatable), std::back_inserter(effects));
    set_verdicts(effects, primary, decided_by_standings(errors));
    match_effects(errors, effects);
    write_rows(folder / "effects.csv", effects);
    std::vector<TimeEffectRow> of_times = time_effects(rows.times, compared);
    set_time_verdicts(of_times, manifest);
    write_rows(folder / "time_effects.csv", of_times);

    StudyResults tables{.manifest = manifest,
                        .errors = std::move(errors),
                        .seeds = {},
                        .times = times,
                        .rounds = rows.times,
                        .effects = std::move(effects),
                        .time_effects = std::move(of_times),
                        .costs = {},
                        .estimates = {}};
    set_dominated(tables, primary);
    write_rows(folder / "summary.csv", tables.errors);
}

void require_evaluation(const std::filesystem::path& folder, const nlohmann::json& manifest) {
    const std::string writer = writer_of(manifest);
    require_table<MetricSummary>(path_inside(folder, "summary.csv"), writer);
    require_table<TimeSummary>(path_inside(folder, "time_summary.csv"), writer);
    require_table<OverScenesRow>(path_inside(folder, "over_scenes.csv"), writer);
    require_table<EffectRow>(path_inside(folder, "effects.csv"), writer);
    require_table<TimeEffectRow>(path_inside(folder, "time_effects.csv"), writer);
}
