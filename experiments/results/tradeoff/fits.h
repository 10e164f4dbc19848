#pragma once
#include "experiments/results/tradeoff/draws.h"

#include <nlohmann/json.hpp>

/// Points of a technique in one shot that differ in one number alone, four or more.
struct QualityAxis {
    std::string technique, parameter;
    std::string fixed;  ///< what else the points have in common that a sweep or a preset gave them
    std::vector<const MeasuredPoint*> points;  ///< by rising value of the parameter
};

/// All axes among points of one shot; `parameters`: an object with all parameters of each point. A point may be in
/// several axes.
std::vector<QualityAxis> quality_axes(std::span<const MeasuredPoint> points,
                                      const std::map<PointName, nlohmann::json>& parameters);

/// error = floor + a cost^-b, with 95 % intervals.
struct Fit {
    std::string status;  ///< "fitted", or why not
    std::optional<double> floor, floor_low, floor_high, a, b, b_low, b_high;
    std::optional<double> misfit;  ///< root of chi^2 per degree of freedom
};

/// By profile: the values whose weighted squares are within s^2 q of the least, where s^2 is the larger of 1 and chi^2
/// per degree of freedom, and q the normal's quantile squared or, where s^2 is estimated by the misfit, Student's. A
/// cost's uncertainty counts as the error that it moves along the curve. Deviations are of logarithms.
Fit fit_law(std::span<const double> costs, std::span<const double> errors, std::span<const double> error_deviations,
            std::span<const double> cost_deviations);

/// The judged points of an axis with their law. `floor_of_costs`: the relative difference that copies of one point may
/// have.
std::pair<std::vector<const MeasuredPoint*>, Fit> fit_axis(const QualityAxis& axis, double floor_of_costs);
