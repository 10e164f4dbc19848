#pragma once
#include "core/gpu/passes/pass_list.h"

#include <memory>

/// split_sum_table() on the GPU, for shaders that include core/shaders/gbuffer/split_sum.glsl.
class SplitSumImage {
public:
    /// The image `split_sum`, rg32f; uploaded when the pass_list has none yet.
    Image on(PassList& pass_list);

private:
    std::weak_ptr<ImageStorage> uploaded_;
};
