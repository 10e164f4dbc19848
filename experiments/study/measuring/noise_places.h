#pragma once
#include "core/host_image.h"
#include "metrics/masks.h"

#include <nlohmann/json.hpp>
#include <vector>

/// Which pixels under a mask hold the noise of a reference: few pixels that meet rare bright paths, or all alike.
struct NoisePlaces {
    size_t pixels = 0;          ///< under the mask
    double noisiest_share = 0;  ///< of the variance, in [0, 1]: in the hundredth of the pixels that has most of it
    /// (sum of v)^2 / sum of v^2 of the pixels' variances v: so many equally noisy pixels would tell as little.
    double carriers = 0;

    /// The pixels of one class of perceptual roughness, and their part of the variance; both in [0, 1].
    struct Class {
        RoughnessClass edges;
        double pixel_share = 0, variance_share = 0;
    };
    std::vector<Class> by_roughness;  ///< ascending, of noise_classes; without those that have no pixel
};

/// Edges of NoisePlaces::by_roughness.
inline constexpr float noise_class_edges[] = {0, 0.1f, 0.3f, 0.6f, 1};

/// `variance`: RGB, of the reference's mean (ReferenceHalves). `roughness`: one channel, perceptual. All of one extent.
/// Of a mask without pixels, and of a reference without noise, all shares are 0.
NoisePlaces noise_places(const HostImage& variance, const HostImage& roughness, const Mask& mask);

/// What manifest.json says of it (`shots[].reference.noise`).
nlohmann::json noise_entry(const NoisePlaces& places, const std::string& target, const std::string& mask);
