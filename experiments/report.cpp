#include "experiments/report.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/report_images.h"
#include "experiments/report_warnings.h"
#include "experiments/summary.h"
#include "metrics/metric.h"

#include <algorithm>
#include <map>

namespace {

using nlohmann::json;

constexpr size_t page_bytes = 30'000'000;  ///< a page is mailed and opened on slow machines: larger ones are not

/// The page's scripts, in the order in which they build on each other.
constexpr const char* scripts[] = {"page.js",       "sections.js", "summary.js", "axes.js",         "charts.js",
                                   "image_data.js", "panes.js",    "viewer.js",  "viewer_input.js", "start.js"};

std::string part(const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/report" / name);
}

std::string html_text(const std::string& text) {
    std::string escaped;
    for (const char c : text)
        escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
    return escaped;
}

/// JSON inside a script element: no "</script>" may end it.
std::string script_text(const json& value) {
    std::string escaped;
    for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace))
        escaped += c == '<' ? "\\u003c" : std::string(1, c);
    return escaped;
}

json optional_json(const std::optional<double>& value) { return value ? json(*value) : json(); }

const char* name_of(Better better) {
    switch (better) {
        case Better::lower:
            return "lower";
        case Better::higher:
            return "higher";
        case Better::near_zero:
            return "near_zero";
        case Better::near_one:
            return "near_one";
    }
    return "";
}

json metric_descriptions() {
    json all = json::object();
    for (const Metric& m : all_metrics())
        all[m.name] = {{"formula", m.formula}, {"unit", m.unit}, {"better", name_of(m.better)}, {"doc", m.doc}};
    return all;
}

/// The summaries as arrays, texts as indices into `texts`: a large sweep repeats few texts many times.
json table_data(std::span<const MetricSummary> errors, std::span<const TimeSummary> times) {
    std::map<std::string, size_t> index;
    json texts = json::array();
    const auto code = [&](const std::string& text) {
        const auto [at, is_new] = index.emplace(text, index.size());
        if (is_new) texts.push_back(text);
        return at->second;
    };
    json error_rows = json::array(), time_rows = json::array();
    for (const MetricSummary& e : errors)
        error_rows.push_back({code(e.shot), code(e.variant), code(e.point), code(e.target), code(e.metric),
                              code(e.formula), code(e.mask), optional_json(e.value), optional_json(e.low),
                              optional_json(e.high), optional_json(e.floor), optional_json(e.seed_deviation), e.seeds,
                              e.is_corrected ? 1 : 0, e.pixels, e.non_finite, e.negative});
    for (const TimeSummary& t : times)
        time_rows.push_back({code(t.shot), code(t.variant), code(t.point), code(t.stage), code(t.clock), t.frames,
                             t.median, t.low, t.high});
    return {{"texts", std::move(texts)}, {"errors", std::move(error_rows)}, {"times", std::move(time_rows)}};
}

/// What a reader without scripts gets: the warnings, and each shot's first metric on its reflective pixels.
std::string static_part(const std::vector<std::string>& warnings, std::span<const MetricSummary> errors) {
    std::string html =
        "<p>Charts, the viewer and sorting need JavaScript. All numbers are in summary.csv and time_summary.csv.</p>\n";
    for (const std::string& warning : warnings) html += "<p class=\"warning\">" + html_text(warning) + "</p>\n";
    if (errors.empty()) return html;
    const auto is_reflective = [](const MetricSummary& e) { return e.mask == "reflective"; };
    const bool has_reflective = std::ranges::any_of(errors, is_reflective);
    const MetricSummary& chosen = has_reflective ? *std::ranges::find_if(errors, is_reflective) : errors.front();
    html += "<table><caption>" + html_text(chosen.metric + " of target " + chosen.target + " on mask " + chosen.mask) +
            "</caption><thead><tr><th>Shot<th>Variant<th>Point<th>Value<th>Low<th>High<th>Floor</tr></thead><tbody>\n";
    const auto cell = [](const std::optional<double>& value) {
        return "<td>" + (value ? json(*value).dump() : "&ndash;");
    };
    for (const MetricSummary& e : errors)
        if (e.metric == chosen.metric && e.formula == chosen.formula && e.target == chosen.target &&
            e.mask == chosen.mask)
            html += "<tr><td>" + html_text(e.shot) + "<td>" + html_text(e.variant) + "<td>" + html_text(e.point) +
                    cell(e.value) + cell(e.low) + cell(e.high) + cell(e.floor) + "</tr>\n";
    return html + "</tbody></table>\n";
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

json image_description(const ReportImage& image) {
    return {{"shot", image.shot},     {"variant", image.variant}, {"point", image.point}, {"kind", image.kind},
            {"target", image.target}, {"seed", image.seed},       {"width", image.width}, {"height", image.height}};
}

}  // namespace

void write_report(const std::filesystem::path& folder) {
    const json manifest = read_json(folder / "manifest.json");
    if (!manifest.is_object()) fail((folder / "manifest.json").string(), " must be a JSON object");
    const std::vector<MetricSummary> errors = summarise(read_result_rows(folder / "results.csv"));
    std::vector<TimeSummary> times;
    if (std::filesystem::exists(folder / "times.csv")) times = summarise(read_time_rows(folder / "times.csv"));
    write_summaries(folder, errors, times);

    const std::vector<std::string> warnings = report_warnings(manifest, errors, times);
    json data = table_data(errors, times);
    data["manifest"] = manifest;
    data["metrics"] = metric_descriptions();
    data["warnings"] = warnings;
    std::string script;
    for (const char* name : scripts) script += part(name);
    std::map<std::string, std::string> values = {
        {"style", part("style.css")}, {"script", script}, {"static", static_part(warnings, errors)}};

    size_t used = script_text(data).size() + 100'000;  // the template, descriptions and notes
    for (const auto& [name, text] : values) used += text.size();
    const ReportImages images = report_images(folder, manifest, used < page_bytes ? page_bytes - used : 0);
    data["notes"] = images.notes;
    data["images"] = json::array();
    for (const ReportImage& image : images.images) {
        values["images"] += "<script type=\"text/plain\" id=\"image-" + std::to_string(data["images"].size()) + "\">" +
                            image.data + "</script>\n";
        data["images"].push_back(image_description(image));
    }
    values.emplace("images", "");
    values["data"] = script_text(data);
    const json title = manifest.value("title", json());
    values["title"] = html_text(title.is_string() ? title.get<std::string>() : "Study");
    write_text(folder / "report.html", filled(part("template.html"), values));
}
