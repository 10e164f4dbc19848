#pragma once
#include "core/gpu/image.h"

/// What each technique estimates for each pixel of the G-buffer, in images of the pass_list's extent. The formats are
/// the technique's own choice, which the composite reads as floats.
struct Reflections {
    /// Mean incident radiance over the specular lobe, before the BRDF (rgb, W sr^-1 m^-2); finite even where
    /// `confidence` is 0, as the composite multiplies both.
    Image radiance;
    /// In [0, 1]: 0 where the fallback should be used, 1 where `radiance` should, between them their mix. The masks
    /// `hit` and `miss` separate the pixels at 0.5 (metrics/masks.cpp).
    Image confidence;
    unsigned confidence_channel = 0;  ///< of `confidence`, which may be `radiance` itself
};
