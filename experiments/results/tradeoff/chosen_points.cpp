#include "experiments/results/tradeoff/chosen_points.h"

#include "core/json_types.h"
#include "experiments/results/tradeoff/tradeoff_shots.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

using nlohmann::json;

std::string fits(const TradeoffPoint& point, double cost) {
    if (!point.row.cost) return "not timed";
    return point.fits_from <= cost ? "surely" : point.may_fit_from <= cost ? "maybe" : "no";
}

/// Geometric mean over scenes of the point's error over the baseline's, in these shots.
double mean_elsewhere(const PointName& name, const std::vector<const TradeoffShot*>& shots) {
    std::vector<ShotValue> logarithms;
    for (const TradeoffShot* shot : shots)
        logarithms.push_back({shot->asset, std::log(*shot->find(name)->row.error / shot->divisor->own)});
    return mean_over_scenes(logarithms).value;
}

}  // namespace

ChosenPoint choose(const TradeoffShot& shot, const std::string& technique, double cost,
                   const std::vector<TradeoffShot>& shots, std::span<const FrozenPoint> frozen) {
    ChosenPoint choice{.shot = shot.name, .technique = technique, .cost = cost};
    for (const FrozenPoint& f : frozen) {
        if (f.technique != technique || f.cost != cost) continue;
        const TradeoffPoint* here = shot.find({technique, f.point});
        if (here && here->has_error())
            choice.point = f.point, choice.chosen_on = "frozen", choice.fits = fits(*here, cost);
        return choice;
    }
    std::vector<const TradeoffPoint*> fitting;
    const TradeoffPoint* cheapest = nullptr;
    for (const TradeoffPoint& p : shot.points) {
        if (!p.can_be_chosen() || p.row.technique != technique) continue;
        if (!cheapest || *p.row.cost < *cheapest->row.cost) cheapest = &p;
        if (*p.row.cost <= cost) fitting.push_back(&p);
    }
    if (!cheapest) return choice;
    std::vector<const TradeoffShot*> common;
    for (const TradeoffShot& other : shots)
        if (other.asset != shot.asset && other.divisor && std::ranges::all_of(fitting, [&](const TradeoffPoint* p) {
                const TradeoffPoint* there = other.find(p->name());
                return there && there->has_error();
            }))
            common.push_back(&other);
    const TradeoffPoint* chosen = cheapest;
    if (!fitting.empty()) {
        choice.chosen_on = common.empty() ? "this shot" : "other scenes";
        chosen = *std::ranges::min_element(fitting, {}, [&](const TradeoffPoint* p) {
            return common.empty() ? *p->row.error : mean_elsewhere(p->name(), common);
        });
        choice.point = chosen->row.point;
    }
    choice.fits = fits(*chosen, cost);
    return choice;
}

std::vector<FrozenPoint> freeze(const std::string& machine, double cost, const std::vector<TradeoffShot>& shots) {
    std::vector<const TradeoffShot*> counted;
    for (const TradeoffShot& shot : shots)
        if (shot.machine == machine && shot.divisor && shot.is_timed()) counted.push_back(&shot);
    std::map<std::string, std::pair<double, std::string>> least;  // by technique: error, point
    if (counted.empty()) return {};
    for (const TradeoffPoint& candidate : counted.front()->points) {
        const PointName name = candidate.name();
        const auto can_be_chosen = [&](const TradeoffShot* shot) {
            const TradeoffPoint* p = shot->find(name);
            return p && p->can_be_chosen();
        };
        const auto is_within = [&](const TradeoffShot* shot) { return *shot->find(name)->row.cost <= cost; };
        if (!std::ranges::all_of(counted, can_be_chosen) ||
            double(std::ranges::count_if(counted, is_within)) < share_within_budget * double(counted.size()))
            continue;
        const double error = mean_elsewhere(name, counted);
        const auto [best, is_first] = least.try_emplace(name.first, error, name.second);
        if (!is_first && error < best->second.first) best->second = {error, name.second};
    }
    std::vector<FrozenPoint> points;
    for (const auto& [technique, best] : least) points.push_back({cost, technique, best.second, machine});
    return points;
}

std::vector<FrozenPoint> frozen_points(const json& manifest) {
    const json config = manifest.value("config", json::object());
    if (!config.is_object() || !config.contains("frozen")) return {};
    const json& frozen = config["frozen"];
    require_type(frozen, json::parse(R"([{"cost": "number", "points": {"*": "text"}}])"),
                 "manifest.json: config.frozen");
    std::vector<FrozenPoint> points;
    for (const json& entry : frozen)
        for (const auto& [technique, point] : entry["points"].items())
            points.push_back({entry["cost"].get<double>(), technique, point.get<std::string>()});
    return points;
}

json frozen_json(const std::vector<FrozenPoint>& points) {
    json entries = json::array();
    for (const FrozenPoint& p : points) {
        if (entries.empty() || entries.back()["cost"] != p.cost)
            entries.push_back({{"cost", p.cost}, {"points", json::object()}});
        entries.back()["points"][p.technique] = p.point;
    }
    return entries;
}
