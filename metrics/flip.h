#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"
#include "metrics/tone_map.h"

/// FLIP models an observer who flips between two images (Andersson et al. 2020, "FLIP: A Difference Evaluator for
/// Alternating Images", PACMCGIT 3(2); HDR: Andersson et al. 2021, Ray Tracing Gems II, chapter 19).

/// A 0.7 m wide display of 3840 pixels at a distance of 0.7 m: 0.7 x 3840 / 0.7 x pi / 180.
inline constexpr float default_pixels_per_degree = 67.0206432766f;

/// Exposures in stops: start + i (stop - start) / (count - 1).
struct FlipExposures {
    float start = 0, stop = 0;
    unsigned count = 1;  ///< at least 1
};

/// The exposures that HDR-FLIP prescribes. The tone map brings the brightest pixel to 85 % at the first exposure and
/// the median pixel at the last. There is about one exposure per stop, at least two. Compute them once per scene, from
/// the full reference image; non-finite pixels are ignored. Fails if the median luminance is not positive, as in a
/// buffer of reflections only: the exposures would be infinite.
FlipExposures flip_exposure_range(const HostImage& full_reference, ToneMap map);

/// LDR-FLIP per pixel, in [0, 1], of linear colours which are clamped to [0, 1]. `pixels_per_degree` in [1, 1000].
Plane flip_map(const HostImage& reference, const HostImage& test, float pixels_per_degree);

/// HDR-FLIP per pixel of linear radiance: the greatest LDR-FLIP over all exposures. Negative radiance counts as 0.
Plane hdr_flip_map(const HostImage& reference, const HostImage& test, const FlipExposures& exposures, ToneMap map,
                   float pixels_per_degree);
