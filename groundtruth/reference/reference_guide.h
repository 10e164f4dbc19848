#pragma once
#include "groundtruth/reference/reference_pixel.h"

struct RenderedGuide {
    ReferenceGuide means;
    HostImage specular_variance;  ///< RGB, of means.specular
};

/// The guide of one frame: the means over `samples` (a multiple of batch_count) of each pixel from a set of their own,
/// independent of the reference's seed and of its settings except max_depth, which `tracer` has. Reports to
/// `run.progress`.
///
/// By default they are a quarter of the reference's. relmse of reflective pixels with a guide's weights over that with
/// the truth's own (roughness_gradient, mirror_pillars, fence, firefly at 48x27, with the environment alone, with all
/// that the image shows, and with noise as the tested image; means of 6 guides): 1.003 to 1.057 of 64 samples, 1.003 to
/// 1.287 of 32, 1.007 to 1.604 of 16. Non-local means over the guide (7x7 pixels of one surface, halves that weigh each
/// other, distances in standard deviations) bring it no nearer: within 0.003 of that in three of the scenes, and to
/// 1.068 in the fourth, where they spread what is bright and rare.
RenderedGuide render_guide(const PixelTracer& tracer, glm::uvec2 extent, unsigned samples, const ReferenceRun& run);
