#pragma once
#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/curves.h"
#include "experiments/results/tradeoff/fits.h"

// What `ssrlab tradeoff` reads off curves between points, and off laws fitted to points.

/// A number with nine significant digits in files.
struct NineDigits : std::optional<double> {
    using std::optional<double>::optional;
    NineDigits(const std::optional<double>& value) : std::optional<double>(value) {}
};
std::string csv_field(const NineDigits& value);

/// The error at a cost: on a technique's curve, and of the technique's ChosenPoint.
struct ErrorAtCostRow {
    std::string shot, scene, machine, technique, label;
    NineDigits cost;
    std::string unit;
    std::string status;  ///< "between", "at", "past end" or "before start" of the front
    NineDigits error, low, high;
    std::string fits;
    NineDigits start, end;  ///< range of costs of the measured front
    std::string point;
    NineDigits point_error, point_low, point_high;
    std::string chosen_on;

    COLUMNS(ErrorAtCostRow, shot, scene, machine, technique, label, cost, unit, status, error, low, high, fits, start,
            end, point, point_error, point_low, point_high, chosen_on)
};

/// The cost of an error on a technique's curve.
struct CostToErrorRow {
    std::string shot, scene, machine, technique, label;
    NineDigits factor, error;  ///< `error` is `factor` times the baseline's
    std::string unit;
    std::string status;  ///< "between", "at", "before start" or "not reached"
    NineDigits cost, low, high, share_that_reach, start, end;

    COLUMNS(CostToErrorRow, shot, scene, machine, technique, label, factor, error, unit, status, cost, low, high,
            share_that_reach, start, end)
};

/// A law fitted along a QualityAxis, and its floor relative to a rung of the truth ladder.
struct FitRow {
    std::string shot, scene, machine, technique, label, parameter, fixed;
    size_t points = 0;
    std::string point_names;
    NineDigits cost_from, cost_to;
    std::string unit;
    NineDigits floor, floor_low, floor_high, a, b, b_low, b_high, misfit;
    std::string status, rung;
    NineDigits rung_error, rung_low, rung_high, floor_over_rung, floor_over_rung_low, floor_over_rung_high;

    COLUMNS(FitRow, shot, scene, machine, technique, label, parameter, fixed, points, point_names, cost_from, cost_to,
            unit, floor, floor_low, floor_high, a, b, b_low, b_high, misfit, status, rung, rung_error, rung_low,
            rung_high, floor_over_rung, floor_over_rung_low, floor_over_rung_high)
};

/// The least error among a shot's ranked points, relative to a rung of the truth ladder.
struct LimitRow {
    std::string shot, scene, machine, rung;
    NineDigits rung_error, rung_low, rung_high;
    std::string technique, point, label;
    NineDigits error, error_low, error_high, over_rung, over_rung_low, over_rung_high, cost;
    std::string unit;

    COLUMNS(LimitRow, shot, scene, machine, rung, rung_error, rung_low, rung_high, technique, point, label, error,
            error_low, error_high, over_rung, over_rung_low, over_rung_high, cost, unit)
};

/// A shot of a Tradeoff with its points, truth ladder and clock.
struct MeasuredShot {
    std::string name, label, scene, machine;
    std::optional<double> divisor;  ///< the baseline's error; none where divisor_of() has none
    double floor = 0;               ///< costs with a smaller relative difference are not distinguished
    bool is_clock_proven = true;    ///< also true for costs that are not timed
    std::vector<MeasuredPoint> points;
    std::vector<Rung> ladder;
    std::vector<std::pair<std::string, Curve>> curves;  ///< by technique, from its judged points
};

/// The rungs of the truth ladder that answers name; the first that a study has is preferred.
inline constexpr std::array<const char*, 2> rungs = {"on_screen", "camera_radiance"};

/// Tables of all shots. Pointers in the lists refer to points of `shots`.
struct BetweenPoints {
    std::vector<std::unique_ptr<MeasuredShot>> shots;
    std::vector<ErrorAtCostRow> error_at_cost;
    std::vector<CostToErrorRow> cost_to_error;
    std::vector<FitRow> fits;
    std::vector<LimitRow> limits;
};

/// Computes the tables. `costs` and `factors` (of the baseline's error) are the question; `found` is tradeoff_of()'s.
BetweenPoints between_points(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             std::span<const double> costs, std::span<const double> factors);
