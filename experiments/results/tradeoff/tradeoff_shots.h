#pragma once
#include "experiments/results/tradeoff/chosen_points.h"
#include "experiments/results/tradeoff/tradeoff.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

// The shots of a study as tradeoff.cpp and chosen_points.cpp share them.

struct TradeoffPoint {
    FrontRow row;
    const MetricSummary* error = nullptr;
    double fits_from = 0, may_fit_from = 0;  ///< as TimeSummary's
    bool is_judged = false;                  ///< by error and cost, in its own shot
    bool uses_scene_data = false;
    PointName name() const { return {row.technique, row.point}; }
    /// Whether it can stand for its technique at a cost: in many scenes one seed in each is enough.
    bool can_be_chosen() const { return !uses_scene_data && has_error() && row.cost && *row.cost > 0; }
    /// Whether others can be chosen by it.
    bool has_error() const { return error->counts_over_scenes() && error->extrapolated().low() > 0; }
};

struct TradeoffShot {
    std::string name, scene, asset, group, machine;
    std::optional<Extrapolated> divisor;
    std::vector<TradeoffPoint> points;
    bool is_timed() const { return std::ranges::any_of(points, &TradeoffPoint::can_be_chosen); }
    const TradeoffPoint* find(const PointName& name) const {
        const auto found = std::ranges::find(points, name, &TradeoffPoint::name);
        return found == points.end() ? nullptr : &*found;
    }
    /// Those that have a point which can be chosen.
    std::vector<std::string> techniques() const {
        std::vector<std::string> techniques;
        for (const TradeoffPoint& p : points)
            if (!p.uses_scene_data && p.has_error() && std::ranges::count(techniques, p.row.technique) == 0)
                techniques.push_back(p.row.technique);
        return techniques;
    }
};

/// The point by which a technique stands at a cost in a shot, `frozen` or by the other shots' errors.
ChosenPoint choose(const TradeoffShot& shot, const std::string& technique, double cost,
                   const std::vector<TradeoffShot>& shots, std::span<const FrozenPoint> frozen);

/// The points that a study of other scenes should judge: one of each technique at a cost on a machine, if any.
std::vector<FrozenPoint> freeze(const std::string& machine, double cost, const std::vector<TradeoffShot>& shots);
