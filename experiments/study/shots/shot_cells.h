#pragma once
#include "experiments/study/study_session.h"

/// The cells of a shot that are asked for, into study.finished. What was done before is loaded; what other processes
/// are at is left to the end, and taken over from them. Nothing of the shot itself is loaded if all is done.
/// `rendered`: called when errors or times have been added to study.finished and the shot's references are there, too,
/// so that tables and report can be written.
void do_cells(StudySession& study, const PlannedShot& shot, const CellSelection& selection,
              const std::function<void()>& rendered);
