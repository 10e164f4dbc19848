#pragma once
#include "core/gpu/passes/pass_list.h"

/// Keeps the lit image for the next frame, for techniques whose hits show the previous image. Have one per technique.
class LitHistory {
public:
    /// Adds a draw that keeps `lit`. Returns the image kept in the previous frame; in the first frame, `lit` itself.
    Image previous(PassList& pass_list, const Image& lit);

private:
    Image last_;  ///< image kept in the previous frame
};
