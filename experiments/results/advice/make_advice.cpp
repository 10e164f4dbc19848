#include "core/error.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "experiments/results/advice/advice.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/tradeoff.h"
#include "experiments/results/tradeoff/tradeoff_answers.h"
#include "experiments/results/verdicts/study_points.h"
#include "variants/registry.h"

#include <algorithm>
#include <cstdlib>
#include <set>

namespace {

using nlohmann::json;

constexpr const char* advised_metric = "flip";
constexpr const char* advised_target = "specular";
constexpr const char* advice_baseline = "none";

/// With as many digits as an interval supports, so that the kept file stays small.
std::optional<double> kept_digits(const std::optional<double>& value) {
    return value ? std::optional(std::strtod(number_text(*value, 5).c_str(), nullptr)) : std::nullopt;
}

std::vector<std::string> sizes_of_shots(const json& manifest) {
    std::set<std::string> sizes;
    for (const json& shot : manifest.at("shots"))
        sizes.insert(shot.at("width").dump() + "x" + shot.at("height").dump());
    return {sizes.begin(), sizes.end()};
}

/// When the last of a study's cells was made.
std::string end_of_study(const json& manifest) {
    std::string last;
    for (const json& maker : manifest.value("provenance", json::array()))
        last = std::max(last, maker.value("finished", ""));
    return last;
}

json source_of_advice(const json& manifest) {
    return {{"title", manifest.value("title", "")},
            {"config", manifest.value("study", json::object()).value("config", "")},
            {"commit", commits_of(manifest)},
            {"finished", end_of_study(manifest)},
            {"sizes", sizes_of_shots(manifest)}};
}

std::set<std::string> groups_of_shots(const json& manifest) {
    std::set<std::string> groups;
    for (const json& shot : manifest.at("shots")) groups.insert(shot.value("group", ""));
    return groups;
}

/// "rooms, at rest" as place and movement.
std::pair<std::string, std::string> kind_named(const std::string& group) {
    const size_t comma = group.find(", ");
    const std::string movement = comma == std::string::npos ? "" : group.substr(comma + 2);
    if (comma == 0 || (movement != "at rest" && movement != "in motion"))
        fail("the group of shots '", group, "' names no place and movement; name it as \"rooms, at rest\" or ",
             "\"streets, in motion\" in the study's config");
    return {group.substr(0, comma), movement};
}

/// The study with the errors of one group of shots alone, so that only these choose points and decide.
StudyResults of_group(const StudyResults& study, const std::string& group) {
    StudyResults own = study;
    std::erase_if(own.summary, [&](const MetricSummary& e) {
        return e.metric != advised_metric || e.target != advised_target ||
               shot_entry(study.manifest, e.shot).value("group", "") != group;
    });
    return own;
}

/// Adds the parameters of the study's points that differ from the defaults.
void add_parameters(json& points, const json& manifest) {
    for (const json& v : manifest.at("techniques")) {
        const std::string technique = v.at("technique").get<std::string>(), point = v.at("point").get<std::string>();
        const json parameters = v.value("entry", v).value("parameters", json::object());
        json& known = points[technique][point];
        if (!known.is_null() && known != parameters)
            fail(technique, " ", point, " has other parameters in another study; run all studies with the same points");
        known = parameters;
    }
}

/// The rows of one chip, kind of place, movement and surface.
struct AdviceOfKind {
    const json& manifest;
    const Tradeoff& found;
    AdviceRow kind;  ///< what all rows share
    std::vector<AdviceRow> rows = {};

    AdviceRow row_of(const PointName& name) const {
        AdviceRow row = kind;
        row.technique = name.first, row.point = name.second;
        row.label = point_text(name, point_labels(manifest));
        // A point's name begins with its preset.
        const auto entry = std::ranges::find(technique_table(), name.first, &TechniqueEntry::name);
        if (const std::string word = name.second.substr(0, name.second.find(' '));
            entry != technique_table().end() && std::ranges::count(entry->presets, word, &Preset::name))
            row.preset = word;
        for (const FrontRow& f : found.front) {
            if (PointName(f.technique, f.point) != name) continue;
            row.us = kept_digits(f.cost);
            // Without an interval over places, both ends are the mean.
            if (f.cost_low != f.cost_high) row.us_low = kept_digits(f.cost_low), row.us_high = kept_digits(f.cost_high);
        }
        return row;
    }

    void add_error(AdviceRow row, const AcrossRow& across) {
        row.rank = across.rank, row.ratio = kept_digits(across.ratio);
        row.low = kept_digits(across.low), row.high = kept_digits(across.high);
        row.chance_first = kept_digits(across.chance_first), row.chance_near = kept_digits(across.chance_near);
        row.standing = across.standing, row.scenes = across.scenes, row.of_scenes = across.of_scenes;
        rows.push_back(std::move(row));
    }

    /// The point that an engine should use: the study's frozen one, else that chosen on all scenes of this kind.
    std::string point_within(const std::string& technique, double us) const {
        for (const ChosenPoint& c : found.chosen)
            if (c.technique == technique && c.cost == us && c.chosen_on == "frozen") return c.point;
        for (const FrozenPoint& p : found.to_freeze)
            if (p.technique == technique && p.cost == us) return p.point;
        return "";
    }

    void add_budget(double ms) {
        kind.ms = ms;
        const std::string cost = number_text(1000 * ms, 9);
        std::set<std::string> named;
        for (const AcrossRow& across : found.across) {
            if (across.cost != cost) continue;
            const std::string point = point_within(across.technique, 1000 * ms);
            if (point.empty()) continue;
            named.insert(across.technique);
            add_error(row_of({across.technique, point}), across);
        }
        add_absent(named);
    }

    /// Techniques without a point within the budget, by their cheapest point.
    void add_absent(const std::set<std::string>& named) {
        std::map<std::string, const FrontRow*> cheapest;
        for (const FrontRow& f : found.front) {
            if (named.contains(f.technique) || f.technique == advice_baseline) continue;
            const FrontRow*& least = cheapest[f.technique];
            if (!least || (f.cost && (!least->cost || *f.cost < *least->cost))) least = &f;
        }
        for (const auto& [technique, least] : cheapest) {
            AdviceRow& row = rows.emplace_back(row_of({technique, least->point}));
            row.reason = above_budget;
            if (least->cost && *least->cost <= 1000 * *kind.ms) row.reason = "no error in some scenes";
            if (least->cost) continue;
            row.reason = "no estimated time";
            for (const RefusedEstimate& refused : found.refused)
                if (refused.point == PointName(technique, least->point)) row.reason += ": " + refused.refusal;
        }
    }

    void add_points() {
        kind.ms.reset();
        for (const AcrossRow& across : found.across)
            if (across.cost.empty()) add_error(row_of({across.technique, across.point}), across);
    }
};

/// How many places the times of a group of shots are means over.
size_t places_behind(const std::vector<CostsOfKind>& costs, const std::string& group) {
    const CostsOfKind* longest = nullptr;
    for (const CostsOfKind& of : costs)
        if (group.starts_with(of.group) && (!longest || of.group.size() > longest->group.size())) longest = &of;
    return longest ? longest->places : 0;
}

bool has_mask(const StudyResults& study, const std::string& mask) {
    return std::ranges::any_of(study.summary,
                               [&](const MetricSummary& e) { return e.represents_shot && e.value && e.mask == mask; });
}

void add_kind(Advice& advice, const StudyResults& own, const std::string& group, const std::string& chip,
              size_t places) {
    std::vector<double> costs;
    for (const double ms : advised_budgets) costs.push_back(1000 * ms);
    for (const AdvisedSurface& surface : advised_surfaces) {
        if (!has_mask(own, surface.mask)) continue;
        const PrimaryComparisons error = {.metric = advised_metric,
                                          .mask = surface.mask,
                                          .target = advised_target,
                                          .margin = primary_of(own.manifest).margin};
        const Tradeoff found =
            tradeoff_of(own, {.error = error, .cost = chip, .baseline = "", .costs = costs, .left_out = {}});
        if (found.baseline.first != advice_baseline)
            fail("the study has no technique `none`, by whose error all others are divided; add it to its config");
        std::set<std::string> sizes;
        for (const FrontRow& f : found.front) sizes.insert(f.machine);
        if (sizes.size() > 1) fail("the shots of '", group, "' have several sizes; give them one size in the config");
        const auto [place, movement] = kind_named(group);
        AdviceOfKind of{.manifest = own.manifest,
                        .found = found,
                        .kind = {.chip = chip, .place = place, .movement = movement, .surface = surface.name}};
        of.kind.places = places;
        for (const double ms : advised_budgets) of.add_budget(ms);
        if (&surface == advised_surfaces) of.add_points();
        std::ranges::move(of.rows, std::back_inserter(advice.rows));
    }
}

}  // namespace

Advice make_advice(std::vector<StudyResults> errors, const std::vector<StudyResults>& costs) {
    Advice advice{.rows = {}, .sources = {{"errors", json::array()}, {"costs", json::array()}}};
    std::map<std::string, const StudyResults*> of_chip;
    for (const StudyResults& study : costs) {
        json compilers = json::object();
        for (const EstimateRow& e : study.estimates) compilers[e.chip] = e.driver;
        if (compilers.empty())
            fail("a study of costs has no estimates; its config needs \"costs\": true and \"gpu_compilers\"");
        for (const auto& [chip, driver] : compilers.items())
            if (!of_chip.emplace(chip, &study).second)
                fail("two studies of costs have times of ", chip, "; leave one of them out");
        json source = source_of_advice(study.manifest);
        source["compilers"] = compilers;
        advice.sources["costs"].push_back(source);
    }
    std::set<std::string> known;
    for (StudyResults& study : errors) {
        advice.sources["errors"].push_back(source_of_advice(study.manifest));
        add_parameters(advice.sources["points"], study.manifest);
        const std::set<std::string> groups = groups_of_shots(study.manifest);
        for (const std::string& group : groups)
            if (!known.insert(group).second)
                fail("two studies have shots of the group '", group, "'; leave one of them out");
        std::map<std::string, std::vector<CostsOfKind>> costs_of;
        for (const auto& [chip, times] : of_chip) costs_of[chip] = take_costs_from(*times, chip, study);
        for (const std::string& group : groups) {
            const StudyResults own = of_group(study, group);
            for (const auto& [chip, kinds] : costs_of) add_kind(advice, own, group, chip, places_behind(kinds, group));
        }
    }
    if (advice.rows.empty())
        fail("the studies have no errors of ", advised_target, " ", advised_metric, " over reflective pixels; ",
             "their configs need these among \"targets\", \"metrics\" and \"masks\"");
    advice.sources["rows"] = advice.rows.size();
    return advice;
}
