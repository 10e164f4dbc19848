#pragma once
#include "core/gpu/passes/pass_list.h"
#include "tests/variants/amd_passes.h"

/// What the denoiser gets for one frame.
struct DenoiserInputs {
    CameraData camera;
    HostImage depth, normal, motion;  ///< as in GBuffer
    HostImage radiance, roughness;    ///< rgb and length of the ray; alpha
    HostImage tiles;                  ///< 1 for each listed tile
};

/// Runs the denoiser's passes on given inputs.
struct AmdDenoiserBench {
    PassList pass_list;
    ParameterSet params;
    AmdTracingParameters tracing{params};
    AmdDenoiserParameters denoiser{params};
    GBuffer gbuffer;
    AmdWork work;
    AmdHistories histories;

    AmdDenoiserBench(Device& device, glm::uvec2 extent, const nlohmann::json& parameters);

    /// Uploads the frame's inputs. `before`: the frame before, or nullptr, which makes its depth, normals and alpha 0.
    void begin_frame(const DenoiserInputs& frame, const DenoiserInputs* before);

    Image reprojected() { return pass_list.image("reprojected_radiance", histories.radiance.current.format); }

    /// Uploads what the image's format holds of the channels of `pixels`.
    void upload(const Image& image, const HostImage& pixels);
    void fill(const Image& image, glm::vec4 value);
};

/// The first channels of an image, or those of `image` and zeros.
HostImage resized_channels(const HostImage& image, unsigned channels);
