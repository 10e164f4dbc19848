#include "experiments/stability/stability_report.h"

#include "core/error.h"
#include "experiments/stability/known_failures.h"
#include "experiments/stability/stability_rows.h"
#include "experiments/tables/csv.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

namespace {

using nlohmann::json;

constexpr const char* number_columns[] = {
    "error",         "benign_error", "error_ratio", "seeds",          "non_finite", "spread_pixels", "spread_frames",
    "negative",      "too_bright",   "excess",      "bad_confidence", "time_ratio", "depth_median",  "depth_p999",
    "normal_median", "normal_p999",  "lit_median",  "lit_p999",       "drift",      "drift_noise",   "gain"};

/// Things in the order in which they were first met.
template <class Key>
struct Places {
    std::map<Key, size_t> index;

    std::pair<size_t, bool> operator()(const Key& key) {
        const auto [at, is_new] = index.emplace(key, index.size());
        return {at->second, is_new};
    }
};

using Point = std::pair<std::string, std::string>;  // variant, point

struct CaseText {
    std::string family, group, why;
};

std::map<std::string, CaseText> read_cases(const std::filesystem::path& folder) {
    std::map<std::string, CaseText> cases;
    for (CsvReader csv(folder / "stability_cases.csv"); csv.next();)
        cases[csv.text("case")] = {csv.text("family"), csv.text("group"), csv.text("why")};
    return cases;
}

size_t verdict_index(const std::string& name) {
    const auto found = std::ranges::find(verdict_names(), name, &VerdictName::name);
    if (found == verdict_names().end()) fail("stability.csv: unknown verdict '", name, "'");
    return size_t(found - verdict_names().begin());
}

json measured(const CsvReader& csv) {
    json values = json::object();
    for (const char* column : number_columns)
        if (const std::optional<double> value = csv.optional_number(column); value && *value != 0)
            values[column] = *value;
    for (const char* column : {"first_non_finite", "refusal"})
        if (!csv.text(column).empty()) values[column] = csv.text(column);
    return values;
}

/// Of one variant and one image of a stage.
struct Failures {
    std::vector<std::string> points, cases;
    size_t nan = 0, infinite = 0, first = 0, unexplained = 0;
    std::vector<const KnownFailure*> known;
};

template <class T>
void add_once(std::vector<T>& list, const T& value) {
    if (!std::ranges::count(list, value)) list.push_back(value);
}

json failure_json(const Point& place, const Failures& f) {
    json explanations = json::array();
    for (const KnownFailure* known : f.known)
        explanations.push_back({{"operation", known->operation}, {"mend", known->mend}});
    return {{"variant", place.first},
            {"place", place.second},
            {"points", f.points},
            {"cases", f.cases},
            {"nan", f.nan},
            {"infinite", f.infinite},
            {"first", f.first},
            {"unexplained", f.unexplained},
            {"explanations", explanations}};
}

/// Fills in the stages of which not all is finite, and what is known of them.
void read_stages(const std::filesystem::path& folder, const std::map<std::string, CaseText>& texts,
                 Places<std::string>& cases, Places<Point>& points, json& data) {
    const std::vector<KnownFailure> known = read_known_failures(known_failures_file());
    std::vector<std::pair<Point, Failures>> failures;
    std::tuple<std::string, std::string, std::string> before;
    for (CsvReader csv(folder / "stability_stages.csv"); csv.next();) {
        const size_t nan = csv.count("nan"), infinite = csv.count("infinite");
        if (nan + infinite == 0) continue;  // of --all-stages
        const FailurePlace place{.variant = csv.text("variant"),
                                 .point = csv.text("point"),
                                 .stage = csv.text("stage"),
                                 .image = csv.text("image"),
                                 .case_name = csv.text("case"),
                                 .family = texts.at(csv.text("case")).family,
                                 .group = texts.at(csv.text("case")).group};
        const std::string name = place.stage + ": " + place.image;
        data["stages"].push_back(
            {cases(place.case_name).first, points({place.variant, place.point}).first, name, nan, infinite});
        const Point key = {place.variant, name};
        auto found = std::ranges::find(failures, key, &std::pair<Point, Failures>::first);
        if (found == failures.end()) found = failures.insert(failures.end(), {key, {}});
        Failures& f = found->second;
        add_once(f.points, place.point), add_once(f.cases, place.case_name);
        f.nan += nan, f.infinite += infinite;
        const std::tuple run = {place.case_name, place.variant, place.point};
        const bool is_first = run != std::exchange(before, run);
        const KnownFailure* const explanation = explanation_of(place, known);
        if (explanation) add_once(f.known, explanation);
        f.first += is_first, f.unexplained += is_first && !explanation;
    }
    for (const auto& [place, f] : failures) data["failures"].push_back(failure_json(place, f));
}

std::string point_name(const json& technique) {
    const std::string point = technique["point"];
    return technique["variant"].get<std::string>() + (point == "default" ? "" : " " + point);
}

std::string joined(const json& list, const char* between) {
    std::string text;
    for (const json& part : list) text += (text.empty() ? "" : between) + part.get<std::string>();
    return text;
}

std::string counted(size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// "amd_sssr slides, sdk_1_5; none": each variant once.
std::string by_variant(const json& techniques, const std::vector<size_t>& chosen) {
    std::string text, variant;
    for (const size_t t : chosen) {
        const std::string& own = techniques[t]["variant"].get_ref<const std::string&>();
        if (own == variant)
            text += ", " + techniques[t]["point"].get<std::string>();
        else
            text += (text.empty() ? "" : "; ") + point_name(techniques[t]);
        variant = own;
    }
    return text;
}

struct WorstChange {
    double factor = 0;
    std::string input;
    size_t row = 0;
};

std::string lead_of(const json& data) {
    const json &rows = data["rows"], &techniques = data["techniques"], &cases = data["cases"];
    std::vector<bool> is_finite(techniques.size(), true), spreads(techniques.size(), false);
    std::set<size_t> met_techniques, met_cases;  // but for the metrics' own
    size_t runs = 0, failed = 0;
    WorstChange worst;
    for (size_t r = 0; r < rows.size(); ++r) {
        const size_t technique = rows[r][1];
        if (techniques[technique]["variant"] == "metrics") continue;
        ++runs, met_techniques.insert(technique), met_cases.insert(rows[r][0].get<size_t>());
        const json& values = rows[r][3];
        if (values.contains("non_finite")) ++failed, is_finite[technique] = false;
        if (values.contains("spread_pixels")) spreads[technique] = true;
        for (const char* input : {"depth", "normal", "lit"})
            if (const double factor = values.value(input + std::string("_median"), 0.0); factor > worst.factor)
                worst = {factor, input, r};
    }
    std::vector<size_t> spreading;
    for (size_t t = 0; t < techniques.size(); ++t)
        if (spreads[t]) spreading.push_back(t);
    const auto finite = size_t(std::ranges::count_if(met_techniques, [&](size_t t) { return is_finite[t]; }));
    std::string text = counted(runs, "run") + " of " + counted(met_techniques.size(), "technique") + " in " +
                       counted(met_cases.size(), "case") + ". In " + std::to_string(failed) +
                       " of them a stage holds NaN or Inf; " + std::to_string(finite) +
                       " of the techniques hold none in any. ";
    text += spreading.empty()
                ? "No fault of an input reaches a pixel whose inputs are sound. "
                : "Faults of an input reach pixels whose inputs are sound in " +
                      counted(spreading.size(), "technique") + ": " + by_variant(techniques, spreading) + ". ";
    if (worst.factor > 0) {
        char factor[32];
        std::snprintf(factor, sizeof factor, "%.4g", worst.factor);
        text += "The most by which one step of an input changes the median pixel is " + std::string(factor) +
                " times the step's own size: of " + worst.input + ", in " +
                point_name(techniques[rows[worst.row][1].get<size_t>()]) + ", " +
                cases[rows[worst.row][0].get<size_t>()]["name"].get<std::string>() + ".";
    }
    return text;
}

/// What is not told of only had what other stages passed it.
bool is_told(const json& failure) { return failure["first"] > 0 || !failure["explanations"].empty(); }

/// How failures are told to readers of text: the operations of a place, or that nobody has told of them.
std::string explained(const json& failure, const char* key, const char* between) {
    std::string text;
    for (const json& e : failure["explanations"]) text += (text.empty() ? "" : between) + e[key].get<std::string>();
    if (failure["unexplained"] == 0) return text;
    return text + (text.empty() ? "" : between) + "UNEXPLAINED in " + counted(failure["unexplained"], "run");
}

}  // namespace

json stability_report_data(const std::filesystem::path& folder) {
    if (!std::filesystem::exists(folder / "stability.csv")) return {};
    const std::map<std::string, CaseText> texts = read_cases(folder);
    Places<std::string> cases;
    Places<Point> points;
    json data = {{"verdicts", json::array()}, {"cases", json::array()},  {"techniques", json::array()},
                 {"rows", json::array()},     {"stages", json::array()}, {"failures", json::array()}};
    for (const VerdictName& v : verdict_names()) data["verdicts"].push_back({{"name", v.name}, {"meaning", v.meaning}});
    for (CsvReader csv(folder / "stability.csv"); csv.next();) {
        const std::string name = csv.text("case");
        const Point point = {csv.text("variant"), csv.text("point")};
        if (!texts.contains(name)) fail((folder / "stability_cases.csv").string(), ": lacks the case '", name, "'");
        const auto [c, is_new_case] = cases(name);
        if (is_new_case)
            data["cases"].push_back({{"name", name}, {"group", texts.at(name).group}, {"why", texts.at(name).why}});
        const auto [p, is_new_point] = points(point);
        if (is_new_point) data["techniques"].push_back({{"variant", point.first}, {"point", point.second}});
        data["rows"].push_back({c, p, verdict_index(csv.text("verdict")), measured(csv)});
    }
    read_stages(folder, texts, cases, points, data);
    data["lead"] = lead_of(data);
    return data;
}

std::string failures_text(const json& data) {
    std::string text;
    for (const json& f : data["failures"]) {
        if (!is_told(f)) continue;
        text += "\n" + f["variant"].get<std::string>() + ": " + joined(f["points"], ", ") + "\n  " +
                f["place"].get<std::string>() + ", in " + counted(f["cases"].size(), "case") + ": " +
                joined(f["cases"], ", ") + "\n  fails by: " + explained(f, "operation", "; or ") +
                "\n  mended by: " + explained(f, "mend", "; ") + "\n";
    }
    return text.empty() ? text : "Where values that are not finite arise, and what spreads them:\n" + text;
}

json stability_without_scripts(const json& data) {
    json techniques = json::array(), failures = json::array();
    std::vector<std::vector<size_t>> counts(data["techniques"].size(), std::vector<size_t>(data["verdicts"].size()));
    for (const json& row : data["rows"]) ++counts[row[1].get<size_t>()][row[2].get<size_t>()];
    for (size_t t = 0; t < counts.size(); ++t)
        techniques.push_back({{"technique", point_name(data["techniques"][t])}, {"counts", counts[t]}});
    for (const json& f : data["failures"])
        if (is_told(f))
            failures.push_back({{"technique", f["variant"].get<std::string>() + " " + joined(f["points"], ", ")},
                                {"place", f["place"]},
                                {"cases", joined(f["cases"], ", ")},
                                {"operation", explained(f, "operation", "; or ")},
                                {"mend", explained(f, "mend", "; ")}});
    return {{"lead", data["lead"]},
            {"verdicts", data["verdicts"]},
            {"techniques", techniques},
            {"has_failures", !failures.empty()},
            {"failures", failures}};
}
