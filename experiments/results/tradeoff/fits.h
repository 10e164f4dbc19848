#pragma once
#include "experiments/results/tradeoff/draws.h"

#include <nlohmann/json.hpp>

/// At least four points of a technique in one shot that differ in one number alone.
struct QualityAxis {
    std::string technique, parameter;
    std::string fixed;                         ///< other values that the points share, set by a sweep or a preset
    std::vector<const MeasuredPoint*> points;  ///< by rising value of the parameter
};

/// All axes among the points of one shot; a point may be in several. `parameters`: all parameter values of each point.
std::vector<QualityAxis> quality_axes(std::span<const MeasuredPoint> points,
                                      const std::map<PointName, nlohmann::json>& parameters);

/// error = floor + a cost^-b, with 95 % intervals.
struct Fit {
    std::string status;  ///< "fitted", or why not
    std::optional<double> floor, floor_low, floor_high, a, b, b_low, b_high;
    std::optional<double> misfit;  ///< square root of chi^2 per degree of freedom
};

/// Fits the law. Intervals are by profile: values whose weighted squares are within s^2 q of the least. Here s^2 is the
/// larger of 1 and chi^2 per degree of freedom; q is the squared quantile of the normal, or of Student's t where the
/// misfit estimates s^2. A cost's uncertainty counts as the error that it moves along the curve. Deviations are of
/// logarithms.
Fit fit_law(std::span<const double> costs, std::span<const double> errors, std::span<const double> error_deviations,
            std::span<const double> cost_deviations);

/// The judged points of an axis, and their law. `floor_of_costs`: relative difference that copies of one point may
/// have.
std::pair<std::vector<const MeasuredPoint*>, Fit> fit_axis(const QualityAxis& axis, double floor_of_costs);
