#pragma once
#include "core/gpu/passes/pass_list.h"

/// Keeps the lit image for the next frame, for techniques whose hits show the previous one. One per technique.
class LitHistory {
public:
    /// Adds a draw that keeps `lit`; returns what was kept in the frame before, in the first frame `lit` itself.
    Image previous(PassList& pass_list, const Image& lit);

private:
    Image last_;  ///< where the frame before was kept
};
