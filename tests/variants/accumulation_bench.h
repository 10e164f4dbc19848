#pragma once
#include "tests/variants/diligent_golden.h"

/// A colour with confidence, and the variance of its luminance.
struct Filtered {
    HostImage radiance, variance;
};

/// What DiligentFX's temporal accumulation reads in one frame.
struct AccumulationInputs {
    CameraData camera;
    HostImage motion, previous_depth;  ///< as in GBuffer
    HostImage reprojected_depth;
    HostImage mask;  ///< 1 for each pixel kept
    Filtered resolved;
    HostImage hit_depth;
    Filtered history;
};

/// What its bilateral cleanup reads.
struct CleanupInputs {
    CameraData camera;
    HostImage depth, normal;    ///< as in GBuffer
    HostImage mask, roughness;  ///< 1 for each pixel kept; as in DiligentMask
    Filtered accumulated;
};

/// Runs these passes on given inputs; what accumulation leaves out keeps the values of the run before the last one.
struct AccumulationBench {
    PassList pass_list;
    DiligentParameters parameters;

    AccumulationBench(Device& device, glm::uvec2 extent, const nlohmann::json& overrides);
    Filtered accumulate(const AccumulationInputs& inputs);
    HostImage clean_up(const CleanupInputs& inputs);

private:
    Image upload(const std::string& name, Format format, const HostImage& pixels);
    DiligentMask upload_mask(const HostImage& kept, const HostImage& roughness);
    Format colors() const { return parameters.filter.float_histories ? Format::rgba32f : Format::rgba16f; }
    Format numbers() const { return parameters.filter.float_histories ? Format::r32f : Format::r16f; }
};
