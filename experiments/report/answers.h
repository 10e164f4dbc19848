#pragma once
#include "experiments/report/report_data.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// By which error a study answers: the one that it is made to compare (manifest.json's `primary`), and one that is near
/// to what people see (flip, else ssim; empty if it measures neither).
struct Headline {
    std::string metric, mask, target, perceptual_metric;
};
Headline headline_of(const nlohmann::json& manifest, std::span<const MetricSummary> errors);

/// A point of a study with its error in a shot.
struct AnswerPoint {
    std::string variant, point;
    double value = 0;
    std::optional<double> low, high;  ///< 95 % interval
    std::string label = "";           ///< how the study names it; "": by variant and point
};

/// What a study says of one shot at first sight: which technique, at which cost, and how certain that is, by the
/// standings that evaluation/standings.h decided. Points that use scene data (exact_scene, exact_rays) take no part.
struct ShotAnswer {
    std::string shot;
    std::optional<AnswerPoint> best;      ///< least error of those whose interval holds all noise
    std::vector<AnswerPoint> tied;        ///< ranked ones that are not distinguishable from `best`
    std::vector<AnswerPoint> unranked;    ///< measured, without an interval that holds all noise; the least error first
    std::optional<AnswerPoint> baseline;  ///< `none`, where it was run: no reflections but the environment's
    std::optional<AnswerPoint>
        limit;  ///< error of the truth ladder's rung on_screen: see groundtruth/reference/truth_ladder.h
    std::vector<AnswerPoint> front;  ///< that no other beats in both error and time, by ascending time; a hint, by
                                     ///< means and medians alone
    bool is_clock_proven = false;    ///< that timed the shot; false where nothing was timed
    std::string sentence, perceptual_sentence;  ///< the latter is empty where no perceptual error was measured
};

/// One for each shot that has an error of the headline, in the order of the results.
std::vector<ShotAnswer> shot_answers(const ReportTables& tables, const nlohmann::json& manifest);

/// What the scenes say together of the error of the headline (over_scenes.csv), as a sentence; empty where no point has
/// such an error beside the baseline's.
std::string over_scenes_sentence(const ReportTables& tables, const nlohmann::json& manifest);

/// What is said first, on the page and in the terminal.
struct StudyAnswers {
    std::string over_scenes;
    std::vector<ShotAnswer> shots;
};

nlohmann::json answers_json(const std::vector<ShotAnswer>& answers, const Headline& headline);
