#include "experiments/report/report.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/report/answers.h"
#include "experiments/report/html_text.h"
#include "experiments/report/report_data.h"
#include "experiments/report/report_images.h"
#include "experiments/report/report_warnings.h"
#include "experiments/results/summary.h"
#include "experiments/stability/stability_report.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace {

using nlohmann::json;

constexpr size_t page_bytes =
    30'000'000;  ///< a page is mailed and opened at once: the images of larger ones lie beside it

/// The page's scripts, in the order in which they build on each other.
constexpr const char* scripts[] = {"data.js",
                                   "page.js",
                                   "points.js",
                                   "sections/facts.js",
                                   "plots.js",
                                   "bars.js",
                                   "strips.js",
                                   "ladder.js",
                                   "mistakes.js",
                                   "provenance.js",
                                   "first_screen/summary.js",
                                   "first_screen/error_time.js",
                                   "first_screen/answers.js",
                                   "first_screen/budget.js",
                                   "first_screen/matrix.js",
                                   "first_screen/explore.js",
                                   "sections/hits.js",
                                   "sections/error_shares.js",
                                   "sections/stages.js",
                                   "sections/roughness.js",
                                   "sections/splits.js",
                                   "sections/effects.js",
                                   "sections/temporal.js",
                                   "sections/stability.js",
                                   "viewer/image_data.js",
                                   "viewer/image_colors.js",
                                   "viewer/panes.js",
                                   "viewer/viewer.js",
                                   "viewer/viewer_chooser.js",
                                   "viewer/viewer_look.js",
                                   "viewer/viewer_input.js",
                                   "viewer/loss_maps.js",
                                   "viewer/inspector.js",
                                   "viewer/crops.js",
                                   "start.js"};

std::string part(const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/report/page" / name);
}

/// What the page's Content-Security-Policy allows beside its own scripts where images lie in files: those of its
/// folder, which browsers call 'self' on a web server, and only by their scheme where the page itself is a file.
constexpr const char* linked_scripts = " 'self' file:";

/// JSON inside a script element: no "</script>" may end it.
std::string script_text(const json& value) {
    std::string escaped;
    for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace))
        escaped += c == '<' ? "\\u003c" : std::string(1, c);
    return escaped;
}

/// The rows of `metric` under the headline's target and mask; where there are none such, those of the first.
std::vector<const MetricSummary*> headline_rows(std::span<const MetricSummary> errors, const PointSet& singles,
                                                const Headline& headline, const std::string& metric) {
    std::vector<const MetricSummary*> rows;
    for (const MetricSummary& e : errors)
        if (e.speaks_for_shot && !singles.contains({e.variant, e.point})) rows.push_back(&e);
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

/// Four digits, as the page's scripts show numbers.
std::string number_text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", value);
    return buffer;
}

std::string static_table(const std::vector<const MetricSummary*>& rows, const json& metrics) {
    const MetricSummary& chosen = *rows.front();
    const std::string unit = metrics.value(chosen.metric, json::object()).value("unit", "1");
    std::string html = "<table><caption>" +
                       html_text(chosen.metric + (unit == "1" ? "" : " (" + unit + ")") + " of target " +
                                 chosen.target + " on mask " + chosen.mask) +
                       "</caption><thead><tr><th>Shot<th>Variant<th>Point<th>Value<th>95 % interval<th>Noise "
                       "floor</tr></thead><tbody>\n";
    const auto number = [](const std::optional<double>& value) { return value ? number_text(*value) : "&ndash;"; };
    for (const MetricSummary* e : rows)
        html += "<tr><td>" + html_text(e->shot) + "<td>" + html_text(e->variant) + "<td>" + html_text(e->point) +
                "<td>" + number(e->value) + "<td>" +
                (e->low && e->high ? number(e->low) + " to " + number(e->high) : "&ndash;") + "<td>" +
                number(e->floor) + "</tr>\n";
    return html + "</tbody></table>\n";
}

std::string answers_html(const json& answers) {
    std::string html;
    for (const json& answer : answers)
        html += "<li><b>" + html_text(answer.value("shot", "")) + "</b> " + html_text(answer.value("sentence", "")) +
                " " + html_text(answer.value("perceptual_sentence", "")) + "</li>\n";
    return html.empty() ? "" : "<h2>Answers</h2>\n<ol>\n" + html + "</ol>\n";
}

/// What a reader without scripts gets: the answers, the warnings, and both errors of the headline in each shot.
std::string static_part(const json& data, const Headline& headline, std::span<const MetricSummary> errors,
                        const PointSet& singles) {
    std::string html = answers_html(data["answers"]);
    for (const json& warning : data["warnings"])
        html += "<p class=\"warning\">" + html_text(warning.get<std::string>()) + "</p>\n";
    const std::vector<const MetricSummary*> rows = headline_rows(errors, singles, headline, headline.metric),
                                            others =
                                                headline_rows(errors, singles, headline, headline.perceptual_metric);
    if (!rows.empty()) html += static_table(rows, data["metrics"]);
    if (!others.empty() && others.front()->metric == headline.perceptual_metric)
        html += static_table(others, data["metrics"]);
    return html;
}

/// Replaces each {{name}} of the template once; what is put in is not searched again.
std::string filled(const std::string& page, const std::map<std::string, std::string>& values) {
    std::string out;
    size_t at = 0;
    for (size_t open; (open = page.find("{{", at)) != std::string::npos;) {
        const size_t close = page.find("}}", open);
        out += page.substr(at, open - at) + values.at(page.substr(open + 2, close - open - 2));
        at = close + 2;
    }
    return out + page.substr(at);
}

/// `values`: style, plot, script and, where there are any, images.
void write_page(const std::filesystem::path& folder, const std::string& title, const json& data,
                std::map<std::string, std::string> values, const std::string& for_no_scripts) {
    values["title"] = html_text(title);
    values["data"] = script_text(data);
    values["static"] =
        "<p>Charts, the viewer and sorting need JavaScript. All numbers are in the CSV files beside this page.</p>\n" +
        for_no_scripts;
    values.emplace("images", "");
    values.emplace("script_source", "");
    write_text(folder / "report.html", filled(part("template.html"), values));
}

}  // namespace

std::vector<ShotAnswer> write_report(const std::filesystem::path& folder, bool links_images) {
    const json stability = stability_report_data(folder);
    const std::string stability_part = stability.is_null() ? "" : stability_html(stability);
    std::map<std::string, std::string> values = {{"style", part("style.css") + part("viewer/viewer.css")},
                                                 {"plot", part("vendor/plot.js")}};
    for (const char* name : scripts) values["script"] += part(name);
    if (!stability.is_null() && !std::filesystem::exists(folder / "manifest.json")) {
        // No study: the page has this one section.
        json data = report_data({}, {});
        for (const char* key : {"warnings", "notes", "images"}) data[key] = json::array();
        data["manifest"] = data["defaults"] = json::object();
        data["stability"] = stability, data["is_study"] = false;
        write_page(folder, "What techniques bear", data, values, stability_part);
        return {};
    }
    const json manifest = read_json(folder / "manifest.json");
    if (!manifest.is_object()) fail((folder / "manifest.json").string(), " must be a JSON object");
    const ReportTables tables = read_report_tables(folder, manifest);
    write_rows(folder / "summary.csv", tables.errors);
    write_rows(folder / "time_summary.csv", tables.times);

    const PointSet singles = single_changes(manifest);
    json data = report_data(tables, singles);
    const Headline headline = headline_of(manifest, tables.errors);
    data["headline"] = {{"metric", headline.metric},
                        {"mask", headline.mask},
                        {"target", headline.target},
                        {"perceptual_metric", headline.perceptual_metric}};
    std::vector<ShotAnswer> answers = shot_answers(tables, manifest);
    data["answers"] = answers_json(answers, headline);
    data["manifest"] = manifest;
    data["manifest"].erase("images");  // the page has its own list
    data["manifest"].erase("stale");   // not of this study as it is
    data["warnings"] = report_warnings(manifest, tables.errors, tables.times);
    data["defaults"] = parameter_defaults(manifest);
    data["stability"] = stability, data["is_study"] = true;
    const std::string for_no_scripts = static_part(data, headline, tables.errors, singles) + stability_part;

    size_t used = script_text(data).size() + for_no_scripts.size() + 100'000;  // the template, descriptions and notes
    for (const auto& [name, text] : values) used += text.size();
    const ReportImages images =
        report_images(folder, manifest, links_images || used > page_bytes ? 0 : page_bytes - used);
    data["notes"] = images.notes;
    data["images"] = images.descriptions;
    for (size_t i = 0; i < images.data.size(); ++i)
        values["images"] +=
            "<script type=\"text/plain\" id=\"image-" + std::to_string(i) + "\">" + images.data[i] + "</script>\n";
    if (images.data.size() < images.descriptions.size()) values["script_source"] = linked_scripts;
    const json title = manifest.value("title", json());
    write_page(folder, title.is_string() ? title.get<std::string>() : "Study", data, values, for_no_scripts);
    return answers;
}
