#pragma once
#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/curves.h"
#include "experiments/results/tradeoff/fits.h"

// What `ssrlab tradeoff` reads off curves between points, and off laws that are fitted to them.

/// A number of these tables: nine significant digits in files.
struct NineDigits : std::optional<double> {
    using std::optional<double>::optional;
    NineDigits(const std::optional<double>& value) : std::optional<double>(value) {}
};
std::string csv_field(const NineDigits& value);

/// The error that a cost buys: on a technique's curve, and by the point that stands for it there (ChosenPoint).
struct ErrorAtCostRow {
    std::string shot, scene, machine, technique, label;
    NineDigits cost;
    std::string unit;
    std::string status;  ///< "between", "at", "past end" or "before start" of the front
    NineDigits error, low, high;
    std::string fits;
    NineDigits start, end;  ///< costs between which the front was measured
    std::string point;
    NineDigits point_error, point_low, point_high;
    std::string chosen_on;

    COLUMNS(ErrorAtCostRow, shot, scene, machine, technique, label, cost, unit, status, error, low, high, fits, start,
            end, point, point_error, point_low, point_high, chosen_on)
};

/// The cost that an error asks for on a technique's curve.
struct CostToErrorRow {
    std::string shot, scene, machine, technique, label;
    NineDigits factor, error;  ///< the latter so many times the baseline's
    std::string unit;
    std::string status;  ///< "between", "at", "before start" or "not reached"
    NineDigits cost, low, high, share_that_reach, start, end;

    COLUMNS(CostToErrorRow, shot, scene, machine, technique, label, factor, error, unit, status, cost, low, high,
            share_that_reach, start, end)
};

/// A law along a QualityAxis, and its floor beside a rung of the truth ladder.
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

/// The least error of all ranked points of a shot beside a rung of the truth ladder.
struct LimitRow {
    std::string shot, scene, machine, rung;
    NineDigits rung_error, rung_low, rung_high;
    std::string technique, point, label;
    NineDigits error, error_low, error_high, over_rung, over_rung_low, over_rung_high, cost;
    std::string unit;

    COLUMNS(LimitRow, shot, scene, machine, rung, rung_error, rung_low, rung_high, technique, point, label, error,
            error_low, error_high, over_rung, over_rung_low, over_rung_high, cost, unit)
};

/// A shot of a Tradeoff with its points, and what is known of its truth and its clock.
struct MeasuredShot {
    std::string name, label, scene, machine;
    std::optional<double> divisor;  ///< the baseline's error; none where it is no measure
    double floor = 0;               ///< relative difference of costs below which nothing is said
    bool is_clock_proven = true;    ///< also of costs that are not timed
    std::vector<MeasuredPoint> points;
    std::vector<Rung> ladder;
    std::vector<std::pair<std::string, Curve>> curves;  ///< by technique, of its judged points
};

/// The rungs of the truth ladder that answers name, the first that a study has before the others.
inline constexpr std::array<const char*, 2> rungs = {"on_screen", "camera_radiance"};

/// `found` as tradeoff_of() decided it; lists of shots refer to points of `shots`.
struct BetweenPoints {
    std::vector<std::unique_ptr<MeasuredShot>> shots;
    std::vector<ErrorAtCostRow> error_at_cost;
    std::vector<CostToErrorRow> cost_to_error;
    std::vector<FitRow> fits;
    std::vector<LimitRow> limits;
};

/// `costs`, and `factors` of the baseline's error: what is asked for.
BetweenPoints between_points(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             std::span<const double> costs, std::span<const double> factors);
