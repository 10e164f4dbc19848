#include "experiments/results/tradeoff/tradeoff.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "core/number_text.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/tradeoff_shots.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using nlohmann::json;

std::string text_of(const json& object, const char* key) {
    const json value = object.is_object() ? object.value(key, json()) : json();
    return value.is_string() ? value.get<std::string>() : value.is_null() ? "?" : value.dump();
}

/// Shot to the processor and the device that its times were taken on.
std::map<std::string, std::string> machines_of(const json& manifest) {
    std::map<std::string, std::string> machines;
    for (const json& entry : manifest.value("provenance", json::array())) {
        const json host = entry.value("host", json::object()), device = entry.value("device", json::object());
        const std::string name = text_of(host, "name") + " (" + text_of(host, "cpu") + ", " + text_of(host, "cores") +
                                 " cores), " + text_of(device, "name");
        for (const json& cell : entry.value("cells", json::array())) {
            const std::string what = cell.value("what", "");
            for (const char* kind : {": times", ": timing"})  // the latter in folders of earlier versions
                if (what.ends_with(kind)) machines[what.substr(0, what.rfind(": "))] = name;
        }
    }
    return machines;
}

using Labels = std::map<PointName, std::string>;

/// The shots that have such an error, with all their points.
std::vector<TradeoffShot> shots_of(const StudyResults& tables, const TradeoffQuestion& question, const Labels& labels) {
    std::vector<TradeoffShot> shots;
    for (const MetricSummary& e : tables.summary) {
        if (!e.represents_shot || !e.value || e.target != question.error.target || e.metric != question.error.metric ||
            e.mask != question.error.mask)
            continue;
        auto shot = std::ranges::find(shots, e.shot, &TradeoffShot::name);
        if (shot == shots.end()) {
            const json& entry = shot_entry(tables.manifest, e.shot);
            const std::string scene = entry.value("scene", "");
            shot = shots.insert(shot, TradeoffShot{.name = e.shot,
                                                   .scene = scene.empty() ? e.shot.substr(0, e.shot.find('.')) : scene,
                                                   .asset = asset_of(tables.manifest, e.shot),
                                                   .group = entry.value("group", "")});
        }
        TradeoffPoint& p = shot->points.emplace_back(TradeoffPoint{.error = &e});
        p.row = {.shot = e.shot, .scene = shot->scene, .technique = e.technique, .point = e.point};
        p.row.label = point_text({e.technique, e.point}, labels);
        p.row.error = e.value, p.row.error_low = e.low, p.row.error_high = e.high;
    }
    return shots;
}

void leave_out(std::vector<TradeoffShot>& shots, const std::vector<std::string>& names) {
    const auto has_name = [](const std::string& name) {
        return [&name](const TradeoffShot& shot) { return shot.name == name || shot.scene == name; };
    };
    for (const std::string& name : names)
        if (std::ranges::none_of(shots, has_name(name)))
            fail("the study has no shot or scene '", name, "'; it has ", joined(names_of(shots, &TradeoffShot::name)));
    for (const std::string& name : names) std::erase_if(shots, has_name(name));
}

std::string unit_of(CostKind kind, const std::string& cost) {
    switch (kind) {
        case CostKind::timed:
            return unit_of_times;
        case CostKind::counted:
            return cost;
        case CostKind::estimated:
            return "us on " + cost + ", estimated";
    }
    return "";
}

/// Costs and machines.
void add_costs(std::vector<TradeoffShot>& shots, const StudyResults& tables, const std::string& cost) {
    std::map<std::string, std::string> machines = machines_of(tables.manifest);
    const CostKind kind = cost_kind(tables, cost);
    const bool is_timed = kind == CostKind::timed;
    for (TradeoffShot& shot : shots) {
        std::string clock;
        std::map<PointName, OtherCost> others;
        if (!is_timed) others = other_costs(tables, shot.name, cost);
        for (TradeoffPoint& p : shot.points) {
            p.row.unit = unit_of(kind, cost);
            if (const auto other = others.find(p.name()); other != others.end()) {
                p.row.cost = other->second.value;
                p.row.cost_low = other->second.low, p.row.cost_high = other->second.high;
                p.fits_from = other->second.fits_from, p.may_fit_from = other->second.may_fit_from;
            }
            for (const TimeSummary& t : tables.time_summary) {
                if (!is_timed || t.shot != shot.name || t.stage != "total" ||
                    PointName(t.technique, t.point) != p.name())
                    continue;
                p.row.cost = t.median, p.row.cost_low = t.low, p.row.cost_high = t.high;
                p.fits_from = t.fits_from, p.may_fit_from = t.may_fit_from, clock = t.clock;
            }
        }
        const json& entry = shot_entry(tables.manifest, shot.name);
        shot.machine = text_of(entry, "width") + "x" + text_of(entry, "height");
        if (is_timed && clock.empty())
            shot.machine = "not timed, " + shot.machine;
        else if (is_timed)
            shot.machine = (machines.contains(shot.name) ? machines[shot.name] : "machine not known") + ", " + clock +
                           ", " + shot.machine;
    }
}

/// Who is judged, on the front, or dominated.
void judge_front(TradeoffShot& shot, const std::map<std::pair<PointName, PointName>, std::string>& dominates,
                 const PointSet& using_scene) {
    std::vector<std::tuple<double, double, TradeoffPoint*>> by_cost;
    for (TradeoffPoint& p : shot.points) {
        const FrontRow& row = p.row;
        const bool has_interval = p.error->ranked && row.error_low && row.error_high;
        p.row.machine = shot.machine, p.uses_scene_data = using_scene.contains(p.name());
        p.row.verdict = p.uses_scene_data               ? "uses scene data"
                        : !has_interval                 ? "not ranked"
                        : !row.cost || !(*row.cost > 0) ? "no cost"
                        : !(*row.error > 0)             ? "error not above 0"
                                                        : "front";
        p.is_judged = p.row.verdict == "front";
        if (p.is_judged) by_cost.emplace_back(*row.cost, *row.error, &p);
    }
    std::ranges::sort(by_cost);
    double least = INFINITY;
    for (const auto& [cost, error, p] : by_cost)
        if (error < least) p->row.is_nominal_front = true, least = error;
    const auto listed = [](std::string& list, const TradeoffPoint& p) {
        list += (list.empty() ? "" : "; ") + p.row.label;
    };
    for (TradeoffPoint& p : shot.points)
        for (const TradeoffPoint& other : shot.points) {
            const auto found = dominates.find({other.name(), p.name()});
            if (!p.is_judged || !other.is_judged || found == dominates.end()) continue;
            if (found->second == "yes") listed(p.row.dominated_by, other);
            if (found->second == "maybe") listed(p.row.undecided_with, other);
        }
    for (TradeoffPoint& p : shot.points)
        if (p.is_judged && !p.row.dominated_by.empty())
            p.row.verdict = "dominated";
        else if (p.is_judged && !p.row.undecided_with.empty())
            p.row.verdict = "undecided";
}

/// What is compared over scenes, and which point stands for it in each shot.
struct Contest {
    std::vector<const TradeoffShot*> shots;
    std::vector<std::map<PointName, PointName>> stands_for;  ///< by shot
};

using LessErrors = std::set<std::tuple<std::string, PointName, PointName>>;  // shot, who errs significantly less, more

/// Shots that are certainly won, and shared.
void count_wins(AcrossRow& row, const Contest& contest, const LessErrors& less) {
    const PointName own(row.technique, row.point);
    for (size_t i = 0; i < contest.shots.size(); ++i) {
        const auto& here = contest.stands_for[i];
        if (!here.contains(own)) continue;
        const TradeoffShot& shot = *contest.shots[i];
        const auto error_of = [&](const auto& entry) { return *shot.find(entry.second)->row.error; };
        const auto first = std::ranges::min_element(here, {}, error_of);
        const auto is_near = [&](const auto& entry) {
            return entry.first != first->first && !less.contains({shot.name, first->second, entry.second});
        };
        if (std::ranges::none_of(here, is_near))
            row.wins += first->first == own;
        else
            row.shared += first->first == own || is_near(*here.find(own));
    }
}

std::vector<AcrossRow> across_of(const Contest& contest, double lacking, double margin, const LessErrors& less) {
    std::vector<ShotErrors> errors;
    std::set<std::string> assets;
    for (size_t i = 0; i < contest.shots.size(); ++i) {
        const TradeoffShot& shot = *contest.shots[i];
        assets.insert(shot.asset);
        ShotErrors& own = errors.emplace_back(ShotErrors{.asset = shot.asset, .divisor = shot.divisor, .errors = {}});
        for (const auto& [name, point] : contest.stands_for[i])
            own.errors[name] = shot.find(point)->error->extrapolated();
    }
    std::vector<AcrossRow> rows;
    for (OverScenes& o : compare_over_scenes(errors, lacking, margin)) {
        AcrossRow& row = rows.emplace_back();
        static_cast<OverScenes&>(row) = std::move(o);
        row.of_scenes = assets.size();
        const MedianOverScenes median = median_over_scenes(row.logarithms);
        row.median = std::exp(median.value);
        if (median.low) row.median_low = std::exp(*median.low), row.median_high = std::exp(*median.high);
        if (const auto ends = bootstrap_over_scenes(row.logarithms.front()))
            row.bootstrap_low = std::exp(ends->first), row.bootstrap_high = std::exp(ends->second);
        count_wins(row, contest, less);
    }
    return rows;
}

std::vector<AcrossRow> across_points(const std::vector<TradeoffShot>& shots, double margin, const LessErrors& less) {
    Contest contest;
    for (const TradeoffShot& shot : shots) {
        contest.shots.push_back(&shot);
        std::map<PointName, PointName>& here = contest.stands_for.emplace_back();
        for (const TradeoffPoint& p : shot.points)
            if (!p.uses_scene_data && p.error->counts_over_scenes()) here[p.name()] = p.name();
    }
    return across_of(contest, most_lacking, margin, less);
}

std::vector<AcrossRow> across_at(const std::string& machine, double cost, const std::vector<TradeoffShot>& shots,
                                 const std::vector<ChosenPoint>& chosen, double margin, const LessErrors& less) {
    Contest contest;
    std::map<std::string, std::set<std::string>> fitting;  // technique to assets
    bool is_timed = false;
    for (const TradeoffShot& shot : shots) {
        if (shot.machine != machine) continue;
        contest.shots.push_back(&shot);
        std::map<PointName, PointName>& here = contest.stands_for.emplace_back();
        for (const ChosenPoint& c : chosen) {
            if (c.shot != shot.name || c.cost != cost || c.point.empty()) continue;
            here[{c.technique, ""}] = {c.technique, c.point};
            if (c.fits == "surely") fitting[c.technique].insert(shot.asset);
        }
        is_timed |= shot.is_timed();
    }
    std::vector<AcrossRow> rows = across_of(contest, 0, margin, less);
    for (AcrossRow& row : rows) {
        row.machine = machine, row.cost = number_text(cost, 9), row.label = row.technique;
        if (is_timed) row.scenes_that_fit = double(fitting[row.technique].size());
    }
    return rows;
}

/// All shots first, then each of their groups where there are several.
std::vector<std::string> groups_of(const std::vector<TradeoffShot>& shots) {
    std::vector<std::string> groups;
    for (const TradeoffShot& shot : shots)
        if (std::ranges::count(groups, shot.group) == 0) groups.push_back(shot.group);
    if (groups.size() == 1) groups.clear();
    std::erase(groups, "");
    groups.insert(groups.begin(), "");
    return groups;
}

PointName baseline_named(const std::string& text, const json& manifest) {
    if (text.empty()) return baseline_over_scenes(manifest);
    const size_t colon = text.find(':');
    const PointName asked(text.substr(0, colon), colon == std::string::npos ? "default" : text.substr(colon + 1));
    std::vector<std::string> known;
    for (const json& v : manifest.value("techniques", json::array())) {
        const PointName name(v.value("technique", ""), v.value("point", ""));
        if (name == asked) return asked;
        known.push_back(name.first + ":" + name.second);
    }
    fail("the study has no point ", shortened(text), suggestion(asked.first + ":" + asked.second, known));
}

}  // namespace

Tradeoff tradeoff_of(const StudyResults& tables, const TradeoffQuestion& question) {
    const Labels labels = point_labels(tables.manifest);
    std::vector<TradeoffShot> shots = shots_of(tables, question, labels);
    leave_out(shots, question.left_out);
    if (shots.empty()) {
        std::set<std::string> known;
        for (const MetricSummary& e : tables.summary)
            if (e.represents_shot) known.insert(e.target + " " + e.metric + " " + e.mask);
        const std::string asked = question.error.target + " " + question.error.metric + " " + question.error.mask;
        fail("the study has no errors of ", shortened(asked), suggestion(asked, names_of(known)));
    }
    add_costs(shots, tables, question.cost);
    Tradeoff found{.baseline = baseline_named(question.baseline, tables.manifest)};
    found.kind = cost_kind(tables, question.cost), found.unit = unit_of(found.kind, question.cost);
    std::set<std::string> compared;
    for (const TradeoffShot& shot : shots) compared.insert(shot.name);
    found.refused = refused_estimates(tables, compared, question.cost);
    std::map<std::string, std::map<std::pair<PointName, PointName>, std::string>> dominates;
    LessErrors less;
    for (PairRow& pair : pairs_of(tables, question.error, question.cost)) {
        if (std::ranges::count(shots, pair.shot, &TradeoffShot::name) == 0) continue;
        const PointName a(pair.technique, pair.point), b(pair.other_technique, pair.other_point);
        dominates[pair.shot][{a, b}] = pair.dominates, dominates[pair.shot][{b, a}] = pair.is_dominated;
        if (pair.error_verdict == verdict::less) less.insert({pair.shot, a, b});
        if (pair.error_verdict == verdict::more) less.insert({pair.shot, b, a});
        found.pairs.push_back(std::move(pair));
    }
    const PointSet using_scene = points_using_scene_data(tables.manifest);
    for (TradeoffShot& shot : shots) {
        std::vector<const MetricSummary*> errors;
        for (const TradeoffPoint& p : shot.points) errors.push_back(p.error);
        shot.divisor = divisor_of(errors, found.baseline);
        found.divisors.emplace_back(shot.name, shot.divisor ? std::optional(shot.divisor->own) : std::nullopt);
        judge_front(shot, dominates[shot.name], using_scene);
        for (const TradeoffPoint& p : shot.points) found.front.push_back(p.row);
    }
    const std::vector<FrozenPoint> frozen = frozen_points(tables.manifest);
    std::vector<std::string> machines;
    for (const TradeoffShot& shot : shots) {
        // Frozen points need no times.
        if (!shot.is_timed() && frozen.empty()) continue;
        if (std::ranges::count(machines, shot.machine) == 0) machines.push_back(shot.machine);
        for (const std::string& technique : shot.techniques())
            for (const double cost : question.costs)
                found.chosen.push_back(choose(shot, technique, cost, shots, frozen));
    }
    for (const std::string& machine : machines)
        for (const double cost : question.costs)
            std::ranges::move(freeze(machine, cost, shots), std::back_inserter(found.to_freeze));
    for (const std::string& group : groups_of(shots)) {
        std::vector<TradeoffShot> of_group = shots;
        if (!group.empty()) std::erase_if(of_group, [&](const TradeoffShot& shot) { return shot.group != group; });
        std::vector<AcrossRow> rows = across_points(of_group, question.error.margin, less);
        for (AcrossRow& row : rows) row.label = point_text({row.technique, row.point}, labels);
        for (const std::string& machine : machines)
            for (const double cost : question.costs)
                std::ranges::move(across_at(machine, cost, of_group, found.chosen, question.error.margin, less),
                                  std::back_inserter(rows));
        for (AcrossRow& row : rows) row.group = group;
        std::ranges::move(rows, std::back_inserter(found.across));
    }
    for (AcrossRow& row : found.across) row.baseline = point_text(found.baseline, labels), row.unit = found.unit;
    found.changes = changes_of(tables, question.error, found.front, found.unit, question.cost);
    return found;
}
