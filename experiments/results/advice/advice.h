#pragma once
#include "experiments/results/verdicts/study_results.h"

// advice.csv: which technique errs least within a time on a chip, and which parameters it then has.

/// Budgets of the table, in milliseconds.
inline constexpr double advised_budgets[] = {0.5, 1, 2, 4};

/// Surfaces that can be asked for, by the masks that studies know them by.
struct AdvisedSurface {
    const char *name, *mask, *meaning;
};
inline constexpr AdvisedSurface advised_surfaces[] = {
    {"all", "reflective", "all reflective surfaces"},
    {"mirrors", "roughness_0_0.1", "mirrors (roughness below 0.1)"},
    {"glossy", "roughness_0.1_0.3", "glossy surfaces (roughness 0.1 to 0.3)"},
    {"rough", "roughness_0.3_0.6", "rough surfaces (roughness 0.3 to 0.6)"}};

/// A row of advice.csv: a technique within a budget, by the point that stands for it, or a point at any cost.
struct AdviceRow {
    std::string chip;
    std::optional<double> ms;             ///< the budget; none: a point at any cost
    std::string place, movement;          ///< "rooms"; "at rest" or "in motion"
    std::string surface;                  ///< the name of an AdvisedSurface
    std::string technique, point, label;  ///< if nothing fits: of the cheapest point
    std::string preset;                   ///< that the point started from; "": none
    std::optional<double> rank, ratio, low, high, chance_first, chance_near;  ///< as in OverScenes
    std::string standing;
    size_t scenes = 0, of_scenes = 0;           ///< that have a ratio, and all of this kind
    std::optional<double> us, us_low, us_high;  ///< estimated time: the mean over `places`; no interval below four
    size_t places = 0;
    std::string reason;  ///< why the technique has no error within the budget; "": it has

    COLUMNS(AdviceRow, chip, ms, place, movement, surface, technique, point, label, preset, rank, ratio, low, high,
            chance_first, chance_near, standing, scenes, of_scenes, us, us_low, us_high, places, reason)
};

/// AdviceRow::reason of a technique whose points all take longer.
inline constexpr const char* above_budget = "above the budget";

/// The table, and what it rests on.
struct Advice {
    std::vector<AdviceRow> rows;
    /// {"errors": [study], "costs": [study with "compilers": {chip: driver}], "points": {technique: {point:
    /// parameters}}, "rows": their number}. Parameters are all that differ from the technique's defaults.
    nlohmann::json sources;
};

/// Makes the table from studies of errors and studies of costs, each of its own chips. All choices and verdicts are
/// those of tradeoff_of(), asked for each chip, kind of place, movement and surface alone. A study's groups of shots
/// name place and movement: "rooms, at rest". Rows at any cost are of all reflective surfaces alone, so that the file
/// stays small. Fails with Error where a study lacks what is needed.
Advice make_advice(std::vector<StudyResults> errors, const std::vector<StudyResults>& costs);

/// Writes the rows, and beside them the sources: advice.csv and advice.json.
void write_advice(const std::filesystem::path& csv, const Advice& advice);
/// Fails with Error, which says how to make the table, if it is missing or damaged.
Advice read_advice(const std::filesystem::path& csv);
