#pragma once
#include "experiments/results/verdicts/study_results.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// By which error a study answers: the one that it is made to compare (manifest.json's `primary`), and one that is near
/// to what people see (flip, else ssim; empty if it measures neither).
struct Headline {
    std::string metric, mask, target, perceptual_metric;
    double margin = PrimaryComparisons().margin;  ///< within which errors are equivalent
};
Headline headline_of(const nlohmann::json& manifest, std::span<const MetricSummary> errors);

/// A point of a study with its error in a shot.
struct AnswerPoint {
    std::string technique, point;
    double value = 0;
    std::optional<double> low, high;  ///< 95 % interval
    std::string label = "";           ///< how the study names it; "": by technique and point
};

/// What a study says of one shot at first sight: which technique, at which cost, and how certain that is, by the
/// standings that evaluation/standings.h decided. Points that use scene data (exact_scene, exact_rays) take no part.
struct ShotAnswer {
    std::string shot;
    std::optional<AnswerPoint> best;      ///< least error of those whose interval holds all noise
    std::vector<AnswerPoint> near;        ///< certainly within the margin of `best`, significantly behind it or not
    std::vector<AnswerPoint> tied;        ///< of which nothing is decided beside `best`
    std::vector<AnswerPoint> behind;      ///< significantly worse than `best`, and not certainly within the margin
    std::vector<AnswerPoint> unranked;    ///< measured, without an interval that holds all noise; the least error first
    std::optional<AnswerPoint> baseline;  ///< `none`, where it was run: no reflections but the environment's
    std::optional<AnswerPoint>
        limit;  ///< error of the truth ladder's rung on_screen: see groundtruth/reference/truth_ladder.h
    std::vector<AnswerPoint> front;  ///< that no other beats in both error and time, by ascending time; a hint, by
                                     ///< means and medians alone
    bool is_clock_proven = false;    ///< that timed the shot; false where nothing was timed
    std::string sentence, perceptual_sentence;  ///< the latter is empty where no perceptual error was measured

    /// How many are ranked beside the best.
    size_t others() const { return near.size() + tied.size() + behind.size(); }
};

/// One for each shot that has an error of the headline, in the order of the results.
std::vector<ShotAnswer> shot_answers(const StudyResults& tables);

/// What is said first, on the page and in the terminal: what holds in the study's own scenes, and what may hold in
/// others (scenes_answer.h).
struct StudyAnswers {
    std::string in_these_scenes, in_scenes_like_these;
    std::vector<ShotAnswer> shots;
};

nlohmann::json answers_json(const std::vector<ShotAnswer>& answers, const Headline& headline);
