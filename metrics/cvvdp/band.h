#pragma once
#include "metrics/cvvdp/sensitivity.h"
#include "metrics/float_plane.h"

#include <array>
#include <span>
#include <vector>

/// Values per pixel inside of a band, [channel]; of both images: [test, reference][channel]. For tests.
struct BandStages {
    std::array<std::vector<FloatPlane>, 2> contrast;
    std::array<FloatPlane, 2> background;  ///< cd/m2, by which contrasts are divided; 1x1 for the base band
    std::vector<FloatPlane> sensitivity;   ///< 1x1 for the base band
    std::vector<FloatPlane> mutual_mask;   ///< none for the base band
    std::vector<FloatPlane> difference;
};

/// One level of the pyramids of both images, [channel], and the next coarser one.
struct BandLevels {
    std::span<const FloatPlane> test, reference, coarser_test, coarser_reference;
};

struct Band {
    BandSensitivity sensitivity;
    bool is_doubled;  ///< contrasts count twice in all bands but the first and the base band
};

/// The mean over the pixels of (D + eps)^2 - eps^2, where D are the differences that are seen in one band-pass band:
/// contrasts times sensitivity, masked by what both images have. `map`, if not nullptr, gets the norm over the channels
/// of D times `map_weights`. `stages`, if not nullptr, gets all values between.
PerCvvdpChannel<double> band_difference(const BandLevels& levels, const Band& band, const CvvdpCalibration& calibration,
                                        const PerCvvdpChannel<double>& map_weights, FloatPlane* map,
                                        BandStages* stages);

/// The same of the base band, the coarsest level itself, which is not masked. `levels` needs no coarser one.
PerCvvdpChannel<double> base_band_difference(const BandLevels& levels, const Band& band,
                                             const CvvdpCalibration& calibration,
                                             const PerCvvdpChannel<double>& map_weights, FloatPlane* map,
                                             BandStages* stages);
