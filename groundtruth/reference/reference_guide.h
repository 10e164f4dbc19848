#pragma once
#include "groundtruth/reference/reference_pixel.h"

struct RenderedGuide {
    ReferenceGuide means;
    HostImage specular_variance, diffuse_variance;  ///< RGB, of the means
    HostImage image;                                ///< RGB: all light
    HostImage material_id;                          ///< one channel, as Reference::material_id
};

/// The guide of one frame: means over `samples` (a multiple of batch_count) per pixel, from a separate set of samples.
/// It is independent of the reference's seed and settings, except max_depth, which `tracer` has. Calls `tracer.expect`
/// with the first samples, so that the paths of the others end by what they promise. Reports to `run.progress`.
///
/// By default it has a quarter of the reference's samples. The relmse of reflective pixels with a guide's weights is
/// 1.003 to 1.057 times that with the truth's weights for 64 samples. It is 1.003 to 1.287 times for 32 samples, and
/// 1.007 to 1.604 times for 16. (Means of 6 guides; roughness_gradient, mirror_pillars, fence, firefly at 48x27; tested
/// images: the environment alone, all that the image shows, and noise.) Non-local means over the guide (7x7 pixels of
/// one surface, halves that weigh each other, distances in standard deviations) do not help: three scenes change by
/// less than 0.003, and the fourth reaches 1.068, as rare bright pixels spread.
RenderedGuide render_guide(const PixelTracer& tracer, glm::uvec2 extent, unsigned samples, const ReferenceRun& run);
