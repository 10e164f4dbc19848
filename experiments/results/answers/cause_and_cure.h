#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/summary.h"

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

// Why points of a shot are not ranked and what to do about it, and which differences a study can see at all. All are
// short sentences, each after a blank.

using PointLabels = std::map<PointName, std::string>;  ///< the study's own names of its points; "" and none: by parts

/// One shot's errors under the mask and of the target of the study's headline.
struct JudgedShot {
    std::span<const MetricSummary* const> errors;  ///< by all metrics, with a value, of points that may be ranked
    std::string metric;                            ///< the headline's
    nlohmann::json reference;                      ///< the shot's in manifest.json (`shots[].reference`); may be null
    const PointLabels& labels;
    size_t comparisons = 1;  ///< that are adjusted together (comparisons_left())
};

/// What ranks the points that have no interval of all noise: seeds, or samples of the reference, with the pixels that
/// hold its noise; and the metric of this study that ranks points here now. Empty where all points are ranked.
std::string cure_sentences(const JudgedShot& shot);

/// "Such a study sees differences of 4 % to the best here in 8 of 10 cases."; empty where no pair has an interval.
std::string power_sentence(const JudgedShot& shot);

/// The same over scenes, with how many of them 10 % take. `rows`: of one error, the ranked ones (OverScenesRow::rank).
std::string power_over_scenes_sentence(std::span<const OverScenesRow* const> rows);

/// " flip ranks points over scenes (over_scenes.csv)."; names the first metric that does, under the mask and of the
/// target of `unranked`; empty where none does.
std::string deciding_over_scenes_sentence(std::span<const OverScenesRow> rows, const OverScenesRow& unranked);

/// The samples per pixel, as references have them (16 x 2^k), that most likely have an interval where `samples` have
/// none as one pixel carries nearly all of the noise: twice as many. metrics/README.md says how often that holds.
double samples_needed(double samples);
