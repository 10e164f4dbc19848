#pragma once
#include "core/host_image.h"
#include "metrics/disocclusion.h"
#include "metrics/plane.h"

#include <optional>
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
    const HostImage& confidence;   ///< 1 channel in [0, 1]: the technique's
    float reflective_max_roughness = 0.6f;
    float reflective_min_reflectance = 0.02f;
    const PreviousFrame* previous = nullptr;  ///< nullptr: there is no frame before, so nothing is disoccluded
};

/// Perceptual roughness in [from, below); a class with below = 1 includes 1.
struct RoughnessClass {
    float from, below;
};

/// The class of a mask name of the form roughness_FROM_BELOW, such as "roughness_0.01_0.1" or "roughness_0_0.01"; none
/// for names that do not start with "roughness_". Fails on malformed ones: edges are decimals with 0 <= FROM < BELOW
/// <= 1.
std::optional<RoughnessClass> roughness_class(const std::string& name);

/// The names of roughness classes as a regular expression, for schemas; it leaves the order of the edges unchecked.
inline constexpr const char* roughness_class_pattern = "^roughness_(0|0?\\.[0-9]+)_(0?\\.[0-9]+|1(\\.0+)?)$";

/// "all", "reflective", "hit", "miss", "edge", "disoccluded"; roughness classes come on top of them.
/// - reflective: something was hit, roughness is at most reflective_max_roughness, and the largest channel of
///   reflectance is at least reflective_min_reflectance
/// - hit, miss: reflective pixels with a confidence of at least, or below, one half
/// - edge: pixels within one pixel (8 neighbours) of another material, of a normal more than 20 degrees apart, or of a
///   jump of depth. 1/depth is affine in the screen over every plane, however slanted. A jump is where its second
///   difference exceeds 2 % of the largest of the three values, at any scale and slant.
/// - disoccluded: reflective pixels that the previous frame did not show, see disoccluded()
const std::vector<std::string>& mask_names();

/// Fails on a name that is neither one of mask_names() nor a roughness class.
void check_mask_name(const std::string& name);

/// A roughness class holds the pixels where something was hit, with a roughness in the class and a largest channel of
/// reflectance of at least reflective_min_reflectance. It ignores reflective_max_roughness. Fails on an unknown name,
/// or if the extents differ.
Mask make_mask(const std::string& name, const MaskInputs& inputs);
