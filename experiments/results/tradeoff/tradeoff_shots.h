#pragma once
#include "experiments/results/tradeoff/chosen_points.h"
#include "experiments/results/tradeoff/tradeoff.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

// The shots of a study, in the form that tradeoff.cpp and chosen_points.cpp share.

struct TradeoffPoint {
    FrontRow row;
    const MetricSummary* error = nullptr;
    double fits_from = 0, may_fit_from = 0;  ///< as in TimeSummary
    bool is_judged = false;                  ///< by error and cost, in its own shot
    bool uses_scene_data = false;
    PointName name() const { return {row.technique, row.point}; }
    /// Whether the point can stand for its technique at a cost. One seed in each of many scenes is enough.
    bool can_be_chosen() const { return !uses_scene_data && has_error() && row.cost && *row.cost > 0; }
    /// Whether its error counts for choosing points in other shots.
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
    /// The techniques with an error that counts.
    std::vector<std::string> techniques() const {
        std::vector<std::string> techniques;
        for (const TradeoffPoint& p : points)
            if (!p.uses_scene_data && p.has_error() && std::ranges::count(techniques, p.row.technique) == 0)
                techniques.push_back(p.row.technique);
        return techniques;
    }
};

/// The point that stands for a technique at a cost in a shot: of `frozen`, or chosen by errors in the other shots.
ChosenPoint choose(const TradeoffShot& shot, const std::string& technique, double cost,
                   const std::vector<TradeoffShot>& shots, std::span<const FrozenPoint> frozen);

/// The points that a study of other scenes should judge: at most one of each technique at a cost on a machine.
std::vector<FrozenPoint> freeze(const std::string& machine, double cost, const std::vector<TradeoffShot>& shots);
