#pragma once
#include "experiments/live/watch/page_images.h"
#include "experiments/live/watch/watch_study.h"

/// What the page shows of a results folder that numbers_study() filled: {"shots": [{"shot", "error": a row of
/// summary.csv, "images": {"truth", "now", "none", label of a point: {target: PageImages::add()}}}], "verdicts":
/// [{"label", "verdict", "why", "views": [JudgedView]}]}.
///
/// Verdicts are judge_effects()'s, of `point` against each of `against` and against no reflections; where it cannot
/// decide, "verdict" is "" and "why" its sentence.
nlohmann::json page_numbers(const std::filesystem::path& results, const WatchedPoint& point,
                            const std::vector<WatchedPoint>& against, PageImages& images);

/// What the page shows of a folder that why_study() filled: {"causes": [{"cause", "share"}], "rays": [{"stage",
/// "verdict", "share"}], "hits": {stage: PageImages::add()}}; a list is empty where there is nothing of it.
nlohmann::json page_why(const std::filesystem::path& results, const WatchedPoint& point, PageImages& images);

/// What the page shows of a folder that times_study() filled, as rows of its tables: {"stages": of time_summary.csv,
/// "effects": of time_effects.csv, each with its "label", "estimates": of estimates.csv}.
nlohmann::json page_times(const std::filesystem::path& results, const WatchedPoint& point,
                          const std::vector<WatchedPoint>& against);
