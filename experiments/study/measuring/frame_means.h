#pragma once
#include "experiments/study/measuring/measure.h"

#include <map>
#include <tuple>

/// Means over the frames of a shot, for one point and seed: of rows that differ in the frame alone.
class FrameMeans {
public:
    void add(const FrameRows& frame);

    /// One row for each metric, formula and mask. Pixel counts are summed; a row has no value if any frame has none.
    ///
    /// References of different poses share their random numbers at each pixel. Their noise is therefore correlated
    /// between frames where both poses look alike, and independent between pixels. What noise does to each pixel's part
    /// is summed over the frames, and the interval is noise_half_width() of the sums; none if the noise of any frame is
    /// unknown. Extrapolated errors are extrapolated from the mean of the NoiseGrowth.
    std::vector<ResultRow> rows() const;

private:
    struct Sums {
        std::vector<ResultRow> rows;
        NoisyMap noise;
        bool has_noise = true;  ///< the noise of all frames is known
    };
    std::map<std::tuple<std::string, std::string, std::string>, Sums> sums_;  ///< by metric, formula, mask
};
