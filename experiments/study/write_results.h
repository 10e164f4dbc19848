#pragma once
#include "experiments/study/study_session.h"

/// Writes manifest, tables and report of the finished cells (experiments/docs/results_folder.md). `is_complete`: all
/// cells of the plan are finished; then files of earlier versions of the study are listed, or removed if the settings
/// say so. `before`: the folder's manifest when the run began; null if none. Returns the report's first answers.
StudyAnswers write_results(StudySession& study, bool is_complete, const nlohmann::json& before);
