#pragma once
#include "variants/passes/declaration.h"

/// Fails with Error, which names place and values, unless every frame that the technique's conditions can make up is
/// sound: all that a pass reads is there and was written before it, nothing is read and written by one pass, and there
/// is a result, of the screen's size, that was written. `params`: of the technique. Of more than a thousand such frames
/// a thousand are looked at.
void check_frames(const Declaration& declaration, const ParameterSet& params);
