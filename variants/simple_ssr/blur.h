#pragma once
#include "core/gpu/passes/pass_graph.h"

/// A blur of one size for near and far, as of Killzone Shadow Fall in the slides that technique.json names, whose
/// passes these are for C++. Here, so that who includes it depends on the shader, too.
struct SimpleBlurParameters {
    ParameterSet& params;

    // clang-format off
    Param<float> blur_width{params, "blur_width", 0.0f, {0.0f, 0.25f},
        {"of the screen's height", "half the side of the square over which a pixel of roughness 1 averages its neighbours' "
         "reflections, all weighed alike; smoother ones in proportion, 32 pixels at most; 0: no blur",
         "slides, of Killzone Shadow Fall, without a number"}};
    // clang-format on
};

/// The image `blurred`, rgba32f: rgb radiance, a confidence, as `sharp` has them. Two passes; shaders also read
/// max_roughness, above which pixels neither give nor take.
Image simple_blur(PassGraph& graph, const Image& sharp);
