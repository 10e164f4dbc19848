#pragma once
#include "experiments/study/study_session.h"

#include <span>

// What a run says of results while it works; `most_told_shots` decides which of both.

/// A line with the primary error of a point in a shot, over its seeds. None for a cell without results.
void say_result(StudySession& study, const Cell& cell);

/// A line for a shot with the range of its points' primary errors, and one for each point with pixels that are not
/// finite.
void say_results(StudySession& study, const std::string& shot, std::span<const Cell> cells);
