#pragma once
#include "experiments/results/verdicts/study_results.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// The errors by which a study answers: the one that it is made to compare (manifest.json's `primary`), and a
/// perceptual one (flip, else ssim; empty if neither is measured).
struct Headline {
    std::string metric, mask, target, perceptual_metric;
    double margin = PrimaryComparisons().margin;  ///< errors within this share are equivalent
};
Headline headline_of(const nlohmann::json& manifest, std::span<const MetricSummary> errors);

/// A point of a study with its error in a shot.
struct AnswerPoint {
    std::string technique, point;
    double value = 0;
    std::optional<double> low, high;  ///< 95 % interval
    std::string label = "";           ///< the study's name for the point; "": none
};

/// A study's first answer for one shot: which technique, at which cost, and how certain. Based on
/// MetricSummary::standing (results/verdicts/standings.h). Points that use scene data (exact_scene, exact_rays) take no
/// part.
struct ShotAnswer {
    std::string shot;
    std::optional<AnswerPoint> best;      ///< the least error among points whose interval includes all noise
    std::vector<AnswerPoint> near;        ///< certainly within the margin of `best`, even if significantly worse
    std::vector<AnswerPoint> tied;        ///< undecided against `best`
    std::vector<AnswerPoint> behind;      ///< significantly worse than `best`, and not certainly within the margin
    std::vector<AnswerPoint> unranked;    ///< measured, but without an interval of all noise; ascending errors
    std::optional<AnswerPoint> baseline;  ///< `none`, if it was run: no reflections but the environment's
    std::optional<AnswerPoint> limit;     ///< error of the rung on_screen (groundtruth/reference/truth_ladder.h)
    std::vector<AnswerPoint> front;  ///< not beaten in both error and time, by means and medians alone; ascending time
    bool is_clock_proven = false;    ///< of the clock that timed the shot; false if none did
    std::string sentence, perceptual_sentence;  ///< the latter is empty where no perceptual error was measured

    /// Number of ranked points other than the best.
    size_t others() const { return near.size() + tied.size() + behind.size(); }
};

/// One answer for each shot that has the headline's error, in the order of the results.
std::vector<ShotAnswer> shot_answers(const StudyResults& tables);

/// The first sentences on the page and in the terminal: what holds in the study's own scenes, and what may hold in
/// others (scenes_answer.h).
struct StudyAnswers {
    std::string in_these_scenes, in_scenes_like_these;
    std::vector<ShotAnswer> shots;
};

nlohmann::json answers_json(const std::vector<ShotAnswer>& answers, const Headline& headline);
