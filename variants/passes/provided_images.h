#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/split_sum_image.h"
#include "core/gpu/passes/pass_list.h"
#include "variants/common/blue_noise.h"
#include "variants/common/horizon_image.h"
#include "variants/common/lit_history.h"

struct ProvidedImage {
    std::string name, format, meaning;
};

/// Images that passes may read and that no pass of the technique writes: those of the G-buffer
/// (core/gbuffer/gbuffer_images.h), and those of described(). One per technique.
class ProvidedImages {
public:
    static std::vector<std::string> names();
    static std::vector<ProvidedImage> described();  ///< all but those of the G-buffer
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
