#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/summary.h"

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

// Sentences about why points of a shot are not ranked, what to do about it, and which differences a study can see. Each
// sentence is short and begins with a blank.

/// the study's names of points; missing or "": technique and point
using PointLabels = std::map<PointName, std::string>;

/// One shot's errors, under the headline's mask and of its target.
struct JudgedShot {
    std::span<const MetricSummary* const> errors;  ///< by all metrics, of rankable points with a value
    std::string metric;                            ///< the headline's
    nlohmann::json reference;  ///< the shot's entry in manifest.json (`shots[].reference`); may be null
    const PointLabels& labels;
    size_t comparisons = 1;  ///< number that are adjusted together (comparisons_left())
};

/// How to rank the points that lack an interval of all noise: by more seeds, by more samples of the reference, or by a
/// metric of this study that already ranks points here. Names the pixels that hold the noise. Empty if all are ranked.
std::string cure_sentences(const JudgedShot& shot);

/// "A study like this detects a difference of 4 % from the best in 8 of 10 cases."; empty where no pair has an
/// interval.
std::string power_sentence(const JudgedShot& shot);

/// power_sentence() over scenes, with the number of scenes needed for 10 %. `rows`: of one error, with a rank
/// (OverScenesRow::rank).
std::string power_over_scenes_sentence(std::span<const OverScenesRow* const> rows);

/// " flip ranks points over scenes (over_scenes.csv).": the first metric that does, with the mask and target of
/// `unranked`; empty if none does.
std::string deciding_over_scenes_sentence(std::span<const OverScenesRow> rows, const OverScenesRow& unranked);

/// The samples per pixel (16 x 2^k) that most likely give an interval: twice `samples`, which give none because one
/// pixel carries nearly all noise. metrics/coverage.md says how often that holds.
double samples_needed(double samples);
