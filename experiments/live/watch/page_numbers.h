#pragma once
#include "experiments/live/watch/page_images.h"
#include "experiments/live/watch/watch_study.h"

/// The page's form of a results folder that numbers_study() filled: {"shots": [{"shot", "error": a row of summary.csv,
/// "images": {"truth", "now", "none", label of a point: {target: PageImages::add()}}, "others": [{"label", "error"}] of
/// what `point` is judged against}], "verdicts": [{"label",
/// "verdict", "why", "views": [JudgedView]}]}.
///
/// Verdicts are judge_effects()'s, of `point` against each of `against` and against no reflections. Where it cannot
/// decide, "verdict" is "" and "why" says why.
nlohmann::json page_numbers(const std::filesystem::path& results, const WatchedPoint& point,
                            const std::vector<WatchedPoint>& against, PageImages& images);

/// The page's form of a folder that why_study() filled: {"causes": [{"cause", "share"}], "rays": [{"stage", "verdict",
/// "share"}], "hits": {stage: PageImages::add()}}; lists without data are empty.
nlohmann::json page_why(const std::filesystem::path& results, const WatchedPoint& point, PageImages& images);

/// The page's form of a folder that times_study() filled, as rows of its tables: {"stages": of time_summary.csv,
/// "effects": of time_effects.csv with "label", "estimates": of estimates.csv}.
nlohmann::json page_times(const std::filesystem::path& results, const WatchedPoint& point,
                          const std::vector<WatchedPoint>& against);
