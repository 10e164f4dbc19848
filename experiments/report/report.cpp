#include "experiments/report/report.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/number_text.h"
#include "core/path_inside.h"
#include "experiments/report/page_template.h"
#include "experiments/report/report_data.h"
#include "experiments/report/report_images.h"
#include "experiments/report/report_warnings.h"
#include "experiments/results/answers/answers.h"
#include "experiments/results/answers/scenes_answer.h"
#include "experiments/results/results_schema.h"
#include "experiments/results/verdicts/study_points.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/results/verdicts/verdict_text.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace {

using nlohmann::json;

/// What the page's Content-Security-Policy allows beside its own scripts where images lie in files: those of its
/// folder, which browsers call 'self' on a web server, and only by their scheme where the page itself is a file.
constexpr const char* linked_scripts = " 'self' file:";

/// The rows of `metric` under the headline's target and mask; where there are none such, those of the first.
std::vector<const MetricSummary*> headline_rows(std::span<const MetricSummary> errors, const PointSet& singles,
                                                const Headline& headline, const std::string& metric) {
    std::vector<const MetricSummary*> rows;
    for (const MetricSummary& e : errors)
        if (e.represents_shot && !singles.contains({e.technique, e.point})) rows.push_back(&e);
    const auto narrow = [&](const std::string MetricSummary::*column, const std::string& wanted) {
        const bool has_wanted = std::ranges::any_of(rows, [&](const MetricSummary* e) { return e->*column == wanted; });
        const std::string chosen = has_wanted || rows.empty() ? wanted : rows.front()->*column;
        std::erase_if(rows, [&](const MetricSummary* e) { return e->*column != chosen; });
    };
    narrow(&MetricSummary::target, headline.target);
    narrow(&MetricSummary::metric, metric);
    narrow(&MetricSummary::mask, headline.mask);
    return rows;
}

json error_table(const std::vector<const MetricSummary*>& rows, const json& metrics) {
    const MetricSummary& chosen = *rows.front();
    const std::string unit = metrics.value(chosen.metric, json::object()).value("unit", "1");
    const auto number = [](const std::optional<double>& value) { return value ? number_text(*value) : "–"; };
    json table = {{"metric", chosen.metric + (unit == "1" ? "" : " (" + unit + ")")},
                  {"target", chosen.target},
                  {"mask", chosen.mask},
                  {"rows", json::array()}};
    for (const MetricSummary* e : rows)
        table["rows"].push_back({{"shot", e->shot},
                                 {"technique", e->technique},
                                 {"point", e->point},
                                 {"value", number(e->value)},
                                 {"interval", e->low && e->high ? number(e->low) + " to " + number(e->high) : "–"},
                                 {"floor", number(e->floor)}});
    return table;
}

/// What a reader without scripts gets of a study, as page/no_scripts.html names it: the answers, the warnings, and both
/// errors of the headline in each shot.
json without_scripts(const json& data, const Headline& headline, std::span<const MetricSummary> errors,
                     const PointSet& singles) {
    json values = {{"warnings", data["warnings"]}, {"error_tables", json::array()}};
    if (data.contains("verdict")) values["verdict"] = data["verdict"];
    if (!data["answers"].empty())
        values["answers"] = {{"in_these_scenes", data["in_these_scenes"]},
                             {"in_scenes_like_these", data["in_scenes_like_these"]},
                             {"shots", data["answers"]}};
    const std::vector<const MetricSummary*> rows = headline_rows(errors, singles, headline, headline.metric),
                                            others =
                                                headline_rows(errors, singles, headline, headline.perceptual_metric);
    if (!rows.empty()) values["error_tables"].push_back(error_table(rows, data["metrics"]));
    if (!others.empty() && others.front()->metric == headline.perceptual_metric)
        values["error_tables"].push_back(error_table(others, data["metrics"]));
    return values;
}

/// What the folder holds of the study's data, for programs other than browsers.
json data_files(const std::filesystem::path& folder) {
    json files = json::array();
    const auto add = [&](const std::string& file) {
        if (std::filesystem::exists(path_inside(folder, file))) files.push_back(file);
    };
    const json schema = results_schema({});
    for (const json& table : schema["resources"]) add(table["path"]);
    for (const char* file : {"stability.csv", "verdict.json", "manifest.json", "schema.json"}) add(file);
    return files;
}

}  // namespace

std::string report_page(const std::string& script, const std::string& title, std::string data,
                        const ReportImages& images, json values) {
    std::vector<PageElement> elements = {
        {"data", std::move(data), "application/json"},
        {"image-list", script_text({{"images", images.descriptions}, {"notes", images.notes}}), "application/json"}};
    for (size_t i = 0; i < images.data.size(); ++i) elements.push_back({"image-" + std::to_string(i), images.data[i]});
    return page_text(script, "report", title, std::move(values), elements);
}

StudyAnswers write_report(const std::filesystem::path& folder, bool links_images) {
    if (!std::filesystem::exists(path_inside(folder, "manifest.json"))) {
        if (const StabilityResults stability = read_stability_results(folder); !stability.rows.empty()) {
            // No study: the page has this one section.
            json data = report_data({}, stability, {});
            data["warnings"] = json::array();
            data["manifest"] = data["defaults"] = json::object();
            data["is_study"] = false;
            write_text(folder / "report.html",
                       report_page("report", "Stability under extreme inputs", script_text(data), {},
                                   {{"is_stability", true},
                                    {"stability", stability_without_scripts(stability)},
                                    {"tables",
                                     "stability.csv, stability_cases.csv and "
                                     "stability_stages.csv beside this page"}}));
            return {};
        }
        if (std::filesystem::exists(folder / "study.json"))
            fail("the study in ", folder.string(),
                 " was stopped before its first results; the same `ssrlab run` continues it");
        fail(folder.string(), " holds no results (manifest.json is missing); `ssrlab run` makes some");
    }
    const StudyResults tables = read_study_results(folder, Runs::left_out);
    const StabilityResults stability = read_stability_results(folder);
    const json& manifest = tables.manifest;

    const PointSet singles = single_changes(manifest);
    json data = report_data(tables, stability, singles);
    const Headline headline = headline_of(manifest, tables.summary);
    data["headline"] = {{"metric", headline.metric},
                        {"mask", headline.mask},
                        {"target", headline.target},
                        {"perceptual_metric", headline.perceptual_metric},
                        {"margin", headline.margin}};
    StudyAnswers answers{.shots = shot_answers(tables)};
    if (const std::optional<VerdictLead> verdict = read_verdict(folder)) {
        // Of one renderer's frames: which point is best over scenes was not asked.
        data["verdict"] = {{"headline", verdict->headline}, {"sentences", verdict->sentences}};
    } else {
        answers.in_these_scenes = in_these_scenes(answers.shots, manifest, headline);
        answers.in_scenes_like_these = in_scenes_like_these(tables);
    }
    data["in_these_scenes"] = answers.in_these_scenes;
    data["in_scenes_like_these"] = answers.in_scenes_like_these;
    data["answers"] = answers_json(answers.shots, headline);
    data["manifest"] = json::object();
    for (const auto& [key, value] : manifest.items())
        if (key != "images" && key != "stale")  // the page has its own list; those are not of this study as it is
            data["manifest"][key] = value;
    data["warnings"] = report_warnings(manifest, tables.summary, tables.time_summary);
    data["defaults"] = parameter_defaults(manifest);
    data["is_study"] = true;
    json values = without_scripts(data, headline, tables.summary, singles);
    values["is_study"] = true;
    values["files"] = data_files(folder);
    values["tables"] = "and the images as EXR and PNG in images/, beside this page";
    if (!stability.rows.empty()) values["stability"] = stability_without_scripts(stability);
    const json title = manifest.value("title", json());

    std::string text = script_text(data);
    // Beside the data: scripts, styles, tables for readers without scripts, descriptions and notes of the images.
    const size_t used = text.size() + script_text(values).size() + 1'000'000;
    const ReportImages images =
        report_images(folder, manifest, links_images || used > page_bytes ? 0 : page_bytes - used);
    if (images.data.size() < images.descriptions.size()) values["script_source"] = linked_scripts;
    write_text(folder / "report.html", report_page("report", title.is_string() ? title.get<std::string>() : "Study",
                                                   std::move(text), images, std::move(values)));
    return answers;
}
