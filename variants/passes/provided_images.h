#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/split_sum_image.h"
#include "core/gpu/passes/pass_list.h"
#include "variants/common/blue_noise.h"
#include "variants/common/horizon_image.h"
#include "variants/common/lit_history.h"

/// Images that passes may read and that no pass of the technique writes: those of the G-buffer, and
///     lit_before               the lit image of the frame before (variants/common/lit_history.h)
///     nearest_depths           pyramids of the nearest and of the farthest depths, all their mips
///     farthest_depths          (variants/common/depth_pyramid.h)
///     blue_noise               128x128 pairs in [0, 1), other ones in each frame (variants/common/blue_noise.h):
///                              NoiseShift::r2 in float32; and with other shifts
///     white_noise              white in float32
///     golden_noise             golden_diagonal in 8 bits
///     golden_noise_from_half   golden_diagonal_from_half in 8 bits
///     noise_table              what all of these are made from, for shaders that name it and never look at it
///     blue_noise_texture       64x64 texels of four codes of 8 bits (variants/common/blue_noise.h)
///     split_sum                the integral of the BRDF (core/shaders/gbuffer/split_sum.glsl)
///     below_horizon            share of the draws of the parameters `lobe` and `importance_bias` that go below the
///                              horizon (variants/common/horizon_image.h)
///     black                    one texel, for what a shader names and never looks at
/// One per technique.
class ProvidedImages {
public:
    static std::vector<std::string> names();
    static bool has(const std::string& name);

    /// The stage that makes the image; "" if none does.
    static std::string stage_of(const std::string& name);

    /// Whether the image is a layer of depth behind the visible surfaces (Technique::needs_depth_layers()).
    static bool is_depth_layer(const std::string& name);

    /// The image of that name, made at its first use in a frame, for a pass of `stage`. `params`: of the technique.
    Image image(PassList& pass_list, const GBuffer& gbuffer, const std::string& name, const ParameterSet& params,
                NoiseStage stage = NoiseStage::compute);

    void begin_frame() { made_.clear(); }

private:
    Image make(PassList& pass_list, const GBuffer& gbuffer, const std::string& name, const ParameterSet& params,
               NoiseStage stage);

    std::map<std::string, Image> made_;  // of this frame
    LitHistory lit_;
    BlueNoise noise_;
    SplitSumImage split_sum_;
    HorizonImage horizon_;
    std::weak_ptr<ImageStorage> uploaded_texture_;
};
