#pragma once
#include "core/gpu/pass_graph.h"
#include "tests/variants/golden_vectors.h"
#include "variants/amd_sssr/passes.h"
#include "variants/amd_sssr/tracing_parameters.h"

/// What one frame of a golden denoiser sequence holds: the inputs and what each of the original's passes wrote.
struct GoldenDenoiserFrame {
    CameraData camera;
    HostImage depth, normal, motion;  ///< `motion` in our sign; `normal` with four channels
    HostImage radiance, roughness;    ///< rgb and length of the ray; alpha
    HostImage tiles;                  ///< 1 for each listed tile
    HostImage reprojected, reprojected_variance, sample_count, average;
    HostImage prefiltered, prefiltered_variance;
    HostImage resolved, resolved_variance;

    /// Pixels that the passes write: in listed tiles, alpha below the threshold.
    bool is_compared(unsigned x, unsigned y, unsigned border) const;
};

/// The frames of a set, without noise.exr.
std::vector<GoldenDenoiserFrame> read_denoiser_frames(const std::string& set);

/// Golden sets that hold a denoiser sequence.
std::vector<std::string> golden_denoiser_sets();

/// Runs our passes on golden inputs, with the bindings of the original's host code.
struct DenoiserBench {
    PassGraph graph;
    ParameterSet params;
    TracingParameters tracing{params};
    DenoiserParameters denoiser{params};
    GBuffer gbuffer;
    AmdWork work;
    AmdHistories histories;

    DenoiserBench(Device& device, glm::uvec2 extent, const nlohmann::json& parameters);

    /// Uploads the frame's inputs. `before`: the frame before, or nullptr, which makes its depth, normals and alpha 0.
    void begin_frame(const GoldenDenoiserFrame& frame, const GoldenDenoiserFrame* before);

    Image reprojected() { return graph.image("reprojected_radiance", histories.radiance.current.format); }
};

/// The first channels of an image, or those of `image` and zeros.
HostImage resized_channels(const HostImage& image, unsigned channels);
