#pragma once
#include "metrics/cvvdp/band.h"
#include "metrics/cvvdp/pooling.h"

#include <glm/glm.hpp>

/// What a frame is compared by, after the filters over time: [test, reference][channel].
using FrameChannels = std::array<std::vector<FloatPlane>, 2>;

/// The differences of frames of one size: pyramids, contrasts, masking. Keeps its memory from frame to frame.
class FrameComparison {
public:
    /// `channels` is 3 for stills and 4 for videos. Fails as band_frequencies().
    FrameComparison(glm::uvec2 extent, double pixels_per_degree, unsigned channels,
                    const CvvdpCalibration& calibration);

    /// `map`, if not nullptr, gets what is noticed at each pixel, on the scale of pooled_difference(). `stages`, if not
    /// nullptr, gets the values inside of each band.
    VisibleDifferences compare(const FrameChannels& frame, FloatPlane* map = nullptr,
                               std::vector<BandStages>* stages = nullptr);

private:
    FloatPlane collapsed(std::vector<FloatPlane> bands) const;

    const CvvdpCalibration& calibration_;
    std::vector<Band> bands_;
    std::vector<FrameChannels> coarser_levels_;
    bool is_still_;
};
