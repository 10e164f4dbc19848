#include "experiments/results/stability/stability_results.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "core/path_inside.h"
#include "core/shown_text.h"

#include <cstdio>
#include <map>
#include <set>
#include <tuple>

namespace {

using nlohmann::json;

template <class T>
void add_once(std::vector<T>& list, const T& value) {
    if (!std::ranges::count(list, value)) list.push_back(value);
}

/// What readers of text get to know of a failure: the operations of its place, and where to look for those that
/// failures.json does not have, which are all of a technique that is not ssrlab's.
std::string operations(const StageFailure& failure) {
    std::vector<std::string> texts;
    for (const KnownFailure& known : failure.known) texts.push_back(known.operation);
    if (failure.unexplained)
        texts.push_back("an operation that ssrlab does not know, in " + counted(failure.unexplained, "run") +
                        ": this stage is the first with such values; look in its shader for divisions by 0, "
                        "normalize() of 0, and roots, logarithms and powers of negative numbers");
    return joined(texts, "; or ");
}

std::string fixes(const StageFailure& failure) {
    std::vector<std::string> texts;
    for (const KnownFailure& known : failure.known) texts.push_back(known.fix);
    if (failure.unexplained)
        texts.push_back(
            "the parameter repair_inputs where an input holds such a value, or else a change of the shader");
    return joined(texts, "; ");
}

}  // namespace

StabilityResults read_stability_results(const std::filesystem::path& folder) {
    const auto file = [&](const char* name) { return path_inside(folder, name); };
    if (!std::filesystem::exists(file("stability.csv"))) return {};
    StabilityResults tables{.rows = read_rows<StabilityRow>(file("stability.csv")),
                            .cases = read_rows<StabilityCaseName>(file("stability_cases.csv")),
                            .stages = read_rows<StageRow>(file("stability_stages.csv"))};
    std::set<std::string> known;
    for (const StabilityCaseName& what : tables.cases) known.insert(what.name);
    const auto check = [&](const auto& row) {
        if (!known.contains(row.case_name))
            fail(file("stability_cases.csv").string(), ": lacks the case '", row.case_name, "'");
    };
    std::ranges::for_each(tables.rows, check), std::ranges::for_each(tables.stages, check);
    return tables;
}

std::vector<StageFailure> stage_failures(const StabilityResults& tables) {
    const std::vector<KnownFailure> known = read_known_failures(known_failures_file());
    std::vector<StageFailure> failures;
    std::tuple<std::string, std::string, std::string> before;
    for (const StageRow& row : tables.stages) {
        if (row.nan + row.infinite == 0) continue;  // of --all-stages
        const std::string place = row.stage + ": " + row.image;
        auto failure = std::ranges::find_if(
            failures, [&](const StageFailure& f) { return f.technique == row.technique && f.place == place; });
        if (failure == failures.end())
            failure = failures.insert(failures.end(), {.technique = row.technique, .place = place});
        add_once(failure->points, row.point), add_once(failure->cases, row.case_name);
        failure->nan += row.nan, failure->infinite += row.infinite;
        const std::tuple run = {row.case_name, row.technique, row.point};
        const bool is_first = run != std::exchange(before, run);
        const KnownFailure* const explanation =
            explanation_of(row, *std::ranges::find(tables.cases, row.case_name, &StabilityCaseName::name), known);
        if (explanation) add_once(failure->known, *explanation);
        failure->first += is_first, failure->unexplained += is_first && !explanation;
    }
    return failures;
}

std::string stability_lead(const StabilityResults& tables) {
    std::set<std::string> techniques, cases, failing;
    std::vector<std::pair<std::string, std::vector<std::string>>>
        spreading;  // techniques and what to call their points
    size_t runs = 0, failed = 0;
    double largest = 0;
    std::string where;
    for (const StabilityRow& row : tables.rows) {
        if (row.technique == "metrics") continue;
        const std::string name = point_text({row.technique, row.point});
        ++runs, techniques.insert(name), cases.insert(row.case_name);
        if (row.non_finite) ++failed, failing.insert(name);
        if (row.spread_pixels) {
            auto entry =
                std::ranges::find(spreading, row.technique, &std::pair<std::string, std::vector<std::string>>::first);
            if (entry == spreading.end()) entry = spreading.insert(spreading.end(), {row.technique, {}});
            add_once(entry->second, row.point);
        }
        for (const auto& [input, factor] : {std::pair("depth", row.depth_median),
                                            std::pair("normal", row.normal_median), std::pair("lit", row.lit_median)})
            if (factor.value_or(0.0) > largest)
                largest = *factor, where = std::string(input) + ", in " + name + ", " + row.case_name;
    }
    std::string text = counted(runs, "run") + " of " + counted(techniques.size(), "technique") + " in " +
                       counted(cases.size(), "case") + ". In " + std::to_string(failed) +
                       " of them a stage holds NaN or Inf; " + std::to_string(techniques.size() - failing.size()) +
                       " of the techniques hold none in any. ";
    size_t count = 0;
    std::vector<std::string> names;
    for (const auto& [technique, points] : spreading)
        count += points.size(), names.push_back(point_text({technique, joined(points)}));
    text += spreading.empty() ? "No fault of an input reaches a pixel whose inputs are sound. "
                              : "Faults of an input reach pixels whose inputs are sound in " +
                                    counted(count, "technique") + ": " + joined(names, "; ") + ". ";
    if (largest > 0)
        text += "The most by which one step of an input changes the median pixel is " + number_text(largest) +
                " times the step's own size: of " + where + ".";
    return text;
}

std::vector<std::pair<std::string, std::vector<size_t>>> verdict_counts(const std::vector<StabilityRow>& rows) {
    std::vector<std::pair<std::string, std::vector<size_t>>> counts;
    std::map<std::string, size_t> places;
    for (const StabilityRow& row : rows) {
        const std::string name = point_text({row.technique, row.point});
        const auto [place, is_new] = places.try_emplace(name, counts.size());
        if (is_new) counts.emplace_back(name, std::vector<size_t>(verdict_names().size()));
        ++counts[place->second].second[size_t(row.verdict)];
    }
    return counts;
}

std::string failures_text(const std::vector<StageFailure>& failures) {
    std::string text;
    for (const StageFailure& f : failures)
        if (f.is_source())
            text += "\n" + f.technique + ": " + joined(f.points) + "\n  " + f.place + ", in " +
                    counted(f.cases.size(), "case") + ": " + shown_text(joined(f.cases)) +
                    "\n  fails by: " + operations(f) + "\n  fixed by: " + fixes(f) + "\n";
    return text.empty() ? text : "Where values that are not finite arise, and what spreads them:\n" + text;
}

std::string hidden_text(const std::vector<StabilityRow>& rows) {
    std::map<std::string, std::map<std::optional<unsigned>, std::vector<std::string>>>
        points;  // by stage and number of products
    for (const StabilityRow& row : rows)
        for (const auto& [stage, products] : row.zero_products)
            add_once(points[stage][products], point_text({row.technique, row.point}));
    std::string text;
    for (const auto& [stage, numbers] : points)
        for (const auto& [products, names] : numbers)
            text += "  " + shown_text(stage) + ": " +
                    (products ? counted(*products, "product") : "products that cannot be counted") + " (" +
                    shown_text(joined(names)) + ")\n";
    if (text.empty()) return text;
    return "Some shaders multiply by a constant 0, of which a driver may make 0 even of NaN or Inf, as lavapipe does.\n"
           "The counts of these stages are lower bounds:\n" +
           text;
}

json stability_without_scripts(const StabilityResults& tables) {
    json verdicts = json::array(), techniques = json::array(), failures = json::array();
    for (const VerdictName& verdict : verdict_names()) verdicts.push_back({{"name", verdict.name}});
    for (const auto& [name, counts] : verdict_counts(tables.rows))
        techniques.push_back({{"technique", name}, {"counts", counts}});
    for (const StageFailure& f : stage_failures(tables))
        if (f.is_source())
            failures.push_back({{"technique", f.technique + " " + joined(f.points)},
                                {"place", f.place},
                                {"cases", joined(f.cases)},
                                {"operation", operations(f)},
                                {"fix", fixes(f)}});
    return {{"lead", stability_lead(tables)},
            {"verdicts", verdicts},
            {"techniques", techniques},
            {"has_failures", !failures.empty()},
            {"failures", failures}};
}
