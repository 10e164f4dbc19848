#pragma once
#include "variants/passes/declaration.h"

/// Fails with Error, which names place and values, unless all frames that the technique's conditions can produce are
/// sound:
/// - all that a pass reads exists and was written before
/// - no pass reads and writes the same thing
/// - there is a result of the screen's size that was written
/// Of more than 1000 such frames only 1000 are checked. `params`: of the technique.
void check_frames(const Declaration& declaration, const ParameterSet& params);
