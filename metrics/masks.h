#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"

#include <string>
#include <vector>

/// The images that masks are made from, all of one extent.
struct MaskInputs {
    const HostImage&
        view_depth;  ///< 1 channel: distance along the view axis in metres; 0, negative or Inf where nothing was hit
    const HostImage& normal;       ///< 3 or more channels, xyz unit
    const HostImage& material_id;  ///< 1 channel; 0 where nothing was hit
    const HostImage& roughness;    ///< 1 channel, perceptual
    const HostImage& reflectance;  ///< 1 or more channels: F0 A + F90 B, the split-sum reflectance
    const HostImage& confidence;   ///< 1 channel in [0, 1]: the variant's
    float reflective_max_roughness = 0.6f;
    float reflective_min_reflectance = 0.02f;
};

/// "all", "reflective", "hit", "miss", "edge".
/// - reflective: something was hit, roughness <= reflective_max_roughness, largest channel of reflectance >= its
/// minimum
/// - hit, miss: reflective pixels with a confidence of at least, or below, one half
/// - edge: pixels within one pixel (8 neighbours) of a discontinuity: another material, normals more than 20 degrees
/// apart,
///   or a jump of depth. 1/depth is affine in the screen over every plane, however slanted, so a jump is where its
///   second difference exceeds 2 % of the largest of the three values: free of scale, and blind to slant.
const std::vector<std::string>& mask_names();

/// Fails on an unknown name, or where the extents differ.
Mask make_mask(const std::string& name, const MaskInputs& inputs);
