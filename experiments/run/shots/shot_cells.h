#pragma once
#include "experiments/run/study_session.h"

/// What a process claims of the results folder (CellStore::claim) while it is at a shot.
std::string claim_name(const PlannedShot& shot);

/// The cells of a shot that are asked for, finished in `study`. What was done before is loaded; cells that other
/// processes are at are left to the end of the shot, and taken over from them. Nothing of the shot itself is loaded if
/// all is done. False, and nothing was done, if another process is at the shot, unless `joins`: processes on one folder
/// begin with shots of their own, and help each other with the last ones.
/// `rendered`: called when errors or times have been added and the shot's references are there, too, so that tables and
/// report can be written.
bool do_cells(StudySession& study, const PlannedShot& shot, const CellSelection& selection, bool joins,
              const std::function<void()>& rendered);
