#pragma once
#include "core/gpu/passes/pass_list.h"

#include <memory>

/// share_below_horizon() of lobe_horizon.h on the GPU, for shaders that include frostbite_sssr/horizon.glsl.
class HorizonImage {
public:
    /// The image `below_horizon`, r32f, of the parameters `lobe` and `importance_bias`; uploaded when the pass_list has
    /// none for them yet.
    Image on(PassList& pass_list, const ParameterSet& params);

private:
    std::weak_ptr<ImageStorage> uploaded_;
    unsigned lobe_ = 0;
    float bias_ = 0;
};

/// Column = cosine of the viewer, row = perceptual roughness, both at texel centres (i + 0.5) / 64. Interpolated, its
/// error is below 0.01, or 0.1 for views within 3 degrees of grazing. Made once per process for each lobe and bias: its
/// 4096 integrals would dominate the start of a technique, and every seed starts one.
const HostImage& horizon_table(unsigned lobe, float bias);
