#pragma once
#include "groundtruth/reference/reference.h"

/// A render between or within passes: pixels whose sample_count is below their goal remain to be done.
struct ReferenceState {
    Reference reference;
    ReferenceSettings settings;
    HostImage sample_goal;  ///< one channel: sample_count at the end of the pass under way
    /// Samples of the pixels with the most of them, at the end of the pass under way.
    uint64_t level = 0;
    HostImage guide_variance;  ///< RGB, of reference.guide.specular; only with a target
    // For a render with a target, once its pixels have different goals:
    HostImage earlier;  ///< two channels: before each pixel's last pass, sample_count and the variance of `specular`
    HostImage rays_per_sample;  ///< one channel, of each pixel's last pass; only with a time limit
};

/// One multi-layer EXR: for each output `image`, `image.a`, `image.b`, `image.variance` and so on, and the layers
/// sample_count, lobe_samples, depth, geometric_normal, normal, material_id, highlights, cut_share,
/// guide.specular, guide.incident, guide.diffuse; with an adaptive share directions; with the truth ladder also the
/// outputs camera_radiance and on_screen, and on_screen_share, reflectance, fallback; of the lit colour alone no output
/// but diffuse, and no guide. Header attributes "ssrlab.*" hold settings, keys, code version, seconds, rays, non-finite
/// samples, the audit (reference_audit.h), and the policies that a user of the numbers must know. Images are moved into
/// the file's layers and back, not copied, since they may fill the memory.
void write_reference(const std::filesystem::path& file, Reference& reference, const ReferenceSettings& settings);

/// Fails with Error if the file is missing, truncated, or lacks a layer or an attribute.
Reference read_reference(const std::filesystem::path& file);

/// As write_reference(), with the layers sample_goal, earlier, guide_variance and rays_per_sample.
void write_reference_state(const std::filesystem::path& file, ReferenceState& state);

/// Reads what either function wrote; a finished reference has an empty sample_goal.
ReferenceState read_reference_state(const std::filesystem::path& file);
