#pragma once
#include "experiments/results/tradeoff/chosen_points.h"
#include "experiments/results/tradeoff/other_costs.h"
#include "experiments/results/tradeoff/pairs.h"

inline constexpr const char* unit_of_times = "ms";

/// What `ssrlab tradeoff` is asked (experiments/results/tradeoff/README.md).
struct TradeoffQuestion {
    PrimaryComparisons error;
    std::string cost;      ///< see cost_kind(); "": the median total of a technique's own stages, ms
    std::string baseline;  ///< TECHNIQUE:POINT; "": baseline_over_scenes()
    std::vector<double> costs;
    std::vector<std::string> left_out;  ///< scenes or shots
};

/// A point of a shot with its error, its cost, and its place on the front of both.
struct FrontRow {
    std::string shot, scene, machine;  ///< the last: what costs must have in common to be compared
    std::string technique, point, label;
    std::optional<double> error, error_low, error_high, cost, cost_low, cost_high;
    std::string unit;
    bool is_nominal_front = false;             ///< no other judged point has both less cost and less error
    std::string verdict;                       ///< front, dominated, undecided, or why the point is not judged
    std::string dominated_by, undecided_with;  ///< labels

    COLUMNS(FrontRow, shot, scene, machine, technique, point, label, error, error_low, error_high, cost, cost_low,
            cost_high, unit, is_nominal_front, verdict, dominated_by, undecided_with)
};

/// What holds over the scenes of points, or of techniques at a cost, each at its ChosenPoint; of the shots of one
/// machine where costs count.
struct AcrossRow : OverScenes {
    std::string group;  ///< of shots, as the study groups them; "": all
    std::string machine;
    std::string cost;  ///< as tables ask for it: up to nine digits; "": points, whatever they cost, over all shots
    std::string unit, label, baseline;
    size_t of_scenes = 0;                                 ///< how many there are
    std::optional<double> bootstrap_low, bootstrap_high;  ///< bootstrap_over_scenes()
    double median = 1;                                    ///< over the scenes of error / the baseline's
    std::optional<double> median_low, median_high;        ///< median_over_scenes()
    std::optional<double> scenes_that_fit;  ///< at a cost: in how many it surely fits, if times were taken
    size_t wins = 0, shared = 0;  ///< shots with certainly the least error; with one that is not certainly more

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

/// What a change of one parameter costs and what it buys: of a stage that it switches off, what the stage is worth. In
/// one shot by its effects, over the scenes of one machine by the geometric mean of the errors' ratios and the mean of
/// the costs' differences.
struct ChangeRow {
    std::string shot;  ///< empty: over scenes
    size_t scenes = 1;
    std::string machine, technique, point, label, against_technique, against_point, change;
    double error_ratio = 1;
    std::optional<double> error_low, error_high;
    double cost = 0;  ///< by how much the point costs more
    std::optional<double> cost_low, cost_high;
    std::string unit;
    /// What the dearer costs more for each percent by which the cheaper errs more, where both signs are significant.
    std::optional<double> cost_per_percent, cost_per_percent_low, cost_per_percent_high;
    std::string verdict;

    COLUMNS(ChangeRow, shot, scenes, machine, technique, point, label, against_technique, against_point, change,
            error_ratio, error_low, error_high, cost, cost_low, cost_high, unit, cost_per_percent, cost_per_percent_low,
            cost_per_percent_high, verdict)
};

/// All changes of one parameter among the compared points (effects.csv) that have costs, as `front` has them; `unit`:
/// FrontRow's; `cost`: see cost_kind(). Estimates that are closer than model_decides_from in a shot differ
/// significantly neither there nor over scenes.
std::vector<ChangeRow> changes_of(const StudyResults& tables, const PrimaryComparisons& error,
                                  std::span<const FrontRow> front, const std::string& unit,
                                  const std::string& cost = "");

/// All that is decided of a study's errors and costs; fits and curves between points are Python's.
struct Tradeoff {
    PointName baseline;
    std::vector<std::pair<std::string, std::optional<double>>> divisors;  ///< by shot: divisor_of() the baseline
    std::vector<PairRow> pairs;
    std::vector<FrontRow> front;
    std::vector<ChosenPoint> chosen;
    std::vector<FrozenPoint> to_freeze;  ///< what a study that judges other scenes should hold as its "frozen"
    std::vector<AcrossRow> across;
    std::vector<ChangeRow> changes;
    CostKind kind = CostKind::timed;
    std::string unit;                      ///< of costs
    std::vector<RefusedEstimate> refused;  ///< points without a cost
};

/// Fails with Error where the study has no such error, cost, baseline, shot or scene.
Tradeoff tradeoff_of(const StudyResults& tables, const TradeoffQuestion& question);
