#pragma once
#include "experiments/study/study_session.h"

/// Writes manifest, tables and report of the cells that are finished (experiments/RESULTS.md). `is_complete`: all cells
/// of the plan are; then what earlier versions of the study left is listed, or removed if the settings say so.
/// `before`: the manifest that the folder held when the run began; null if none. Returns what the report says
/// first.
StudyAnswers write_results(StudySession& study, bool is_complete, const nlohmann::json& before);
