#pragma once
#include "experiments/study/study_session.h"

/// Adds the selected cells of a shot to study.finished. Finished cells are loaded; cells that other processes work on
/// come last, and their results are taken over. If all are done, the shot itself is not loaded. `rendered` is called
/// when errors or times have been added and the shot's references exist, so that tables and report can be written.
void do_cells(StudySession& study, const PlannedShot& shot, const CellSelection& selection,
              const std::function<void()>& rendered);
