#pragma once
#include "core/host_image.h"
#include "metrics/masks.h"

#include <nlohmann/json.hpp>
#include <vector>

/// Which pixels under a mask hold the noise of a reference: a few that find rare bright paths, or all alike.
struct NoisePlaces {
    size_t pixels = 0;          ///< under the mask
    double noisiest_share = 0;  ///< share of the variance in the noisiest 1 % of the pixels, in [0, 1]
    /// (sum of v)^2 / sum of v^2 over the pixels' variances v: this many equally noisy pixels would tell as much.
    double carriers = 0;

    /// The pixels of one class of perceptual roughness, and their part of the variance; both in [0, 1].
    struct Class {
        RoughnessClass edges;
        double pixel_share = 0, variance_share = 0;
    };
    std::vector<Class> by_roughness;  ///< ascending, without classes that have no pixel
};

/// Edges of NoisePlaces::by_roughness.
inline constexpr float noise_class_edges[] = {0, 0.1f, 0.3f, 0.6f, 1};

/// `variance`: RGB, of the reference's mean (ReferenceHalves). `roughness`: one channel, perceptual. All of one extent.
/// All shares are 0 for a mask without pixels and for a reference without noise.
NoisePlaces noise_places(const HostImage& variance, const HostImage& roughness, const Mask& mask);

/// The entry of manifest.json (`shots[].reference.noise`).
nlohmann::json noise_entry(const NoisePlaces& places, const std::string& target, const std::string& mask);
