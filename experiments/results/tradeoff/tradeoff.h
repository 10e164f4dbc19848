#pragma once
#include "experiments/results/tradeoff/chosen_points.h"
#include "experiments/results/tradeoff/costs_of_places.h"
#include "experiments/results/tradeoff/other_costs.h"
#include "experiments/results/tradeoff/pairs.h"

inline constexpr const char* unit_of_times = "ms";

/// The question to `ssrlab tradeoff` (experiments/results/tradeoff/README.md).
struct TradeoffQuestion {
    PrimaryComparisons error;
    std::string cost;      ///< see cost_kind(); "": the median total of a technique's own stages, ms
    std::string baseline;  ///< TECHNIQUE:POINT; "": baseline_over_scenes()
    std::vector<double> costs;
    std::vector<std::string> left_out;  ///< scenes or shots
};

/// A point of a shot with its error, its cost, and its place on the front of both.
struct FrontRow {
    std::string shot, scene, machine;  ///< machine: costs of different machines are not compared
    std::string technique, point, label;
    std::optional<double> error, error_low, error_high, cost, cost_low, cost_high;
    std::string unit;
    bool is_nominal_front = false;             ///< no other judged point has less cost and less error
    std::string verdict;                       ///< front, dominated, undecided, or why the point is not judged
    std::string dominated_by, undecided_with;  ///< labels

    COLUMNS(FrontRow, shot, scene, machine, technique, point, label, error, error_low, error_high, cost, cost_low,
            cost_high, unit, is_nominal_front, verdict, dominated_by, undecided_with)
};

/// What holds over scenes: of points, or of techniques at a cost by their ChosenPoint. Rows with costs are of the shots
/// of one machine.
struct AcrossRow : OverScenes {
    std::string group;  ///< the study's group of shots; "": all
    std::string machine;
    std::string cost;  ///< up to nine digits; "": points at any cost, over all shots
    std::string unit, label, baseline;
    size_t of_scenes = 0;                                 ///< number of all scenes
    std::optional<double> bootstrap_low, bootstrap_high;  ///< bootstrap_over_scenes()
    double median = 1;                                    ///< over the scenes, of error / baseline's error
    std::optional<double> median_low, median_high;        ///< median_over_scenes()
    std::optional<double> scenes_that_fit;                ///< scenes where it surely fits the cost, if timed
    size_t wins = 0, shared = 0;  ///< shots with certainly the least error; shots where it may have the least

    static constexpr auto columns() {
        return std::tuple_cat(
            MEMBER_COLUMNS(AcrossRow, group, machine, cost, unit, technique, point, label, baseline, scenes, of_scenes,
                           shots, ratio, low, high, bootstrap_low, bootstrap_high, median, median_low, median_high,
                           scenes_that_fit, wins, shared, rank, rank_low, rank_high),
            std::tuple(Column{"against_best", &AcrossRow::over_best},
                       Column{"against_best_low", &AcrossRow::over_best_low},
                       Column{"against_best_high", &AcrossRow::over_best_high}),
            MEMBER_COLUMNS(AcrossRow, p_holm, p_equivalent, chance_first, chance_near, standing, scenes_needed,
                           scenes_needed_low, scenes_needed_high));
    }
};

/// Cost and benefit of a change of one parameter; if it switches a stage off, the value of that stage. In one shot by
/// the study's effects; over one machine's scenes by the geometric mean of errors' ratios and the mean of costs'
/// differences.
struct ChangeRow {
    std::string shot;  ///< empty: over scenes
    size_t scenes = 1;
    std::string machine, technique, point, label, against_technique, against_point, change;
    double error_ratio = 1;
    std::optional<double> error_low, error_high;
    double cost = 0;  ///< difference: positive if the point costs more
    std::optional<double> cost_low, cost_high;
    std::string unit;
    /// How much more the dearer costs for each percent by which the cheaper errs more, where both signs are
    /// significant.
    std::optional<double> cost_per_percent, cost_per_percent_low, cost_per_percent_high;
    std::string verdict;

    COLUMNS(ChangeRow, shot, scenes, machine, technique, point, label, against_technique, against_point, change,
            error_ratio, error_low, error_high, cost, cost_low, cost_high, unit, cost_per_percent, cost_per_percent_low,
            cost_per_percent_high, verdict)
};

/// All changes of one parameter among compared points (effects.csv) with costs, which are as in `front`. `unit`: of
/// FrontRow; `cost`: see cost_kind(). Estimates closer than model_decides_from in a shot differ significantly neither
/// in that shot nor over scenes.
std::vector<ChangeRow> changes_of(const StudyResults& tables, const PrimaryComparisons& error,
                                  std::span<const FrontRow> front, const std::string& unit,
                                  const std::string& cost = "");

/// All decisions about a study's errors and costs. BetweenPoints has the fits and the curves between points.
struct Tradeoff {
    PointName baseline;
    std::vector<std::pair<std::string, std::optional<double>>> divisors;  ///< divisor_of() the baseline, by shot
    std::vector<PairRow> pairs;
    std::vector<FrontRow> front;
    std::vector<ChosenPoint> chosen;
    std::vector<FrozenPoint> to_freeze;  ///< "frozen" points for a study of other scenes
    std::vector<AcrossRow> across;
    std::vector<ChangeRow> changes;
    CostKind kind = CostKind::timed;
    std::string unit;                      ///< of costs
    std::vector<RefusedEstimate> refused;  ///< points without an estimated cost
    std::vector<CostsOfKind> costs_from;   ///< of another study, see take_costs_from(); empty: the study's own
};

/// Fails with Error where the study has no such error, cost, baseline, shot or scene.
Tradeoff tradeoff_of(const StudyResults& tables, const TradeoffQuestion& question);
