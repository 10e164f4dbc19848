#pragma once
#include "experiments/study/measuring/measure.h"

#include <map>
#include <tuple>

/// The means over the frames of a shot, of one technique point and seed: of rows that differ in nothing but the frame.
class FrameMeans {
public:
    void add(const FrameRows& frame);

    /// Pixels are summed. No value if one frame has none. The references of poses share their random numbers at each
    /// pixel, and so their noise where both poses look alike; pixels are independent. So what noise does to each
    /// pixel's part is summed over the frames, as it comes, and the interval is noise_half_width() of the sums; none if
    /// the noise of one frame is unknown. Those that are extrapolated are so from the mean of the NoiseGrowth.
    std::vector<ResultRow> rows() const;

private:
    struct Sums {
        std::vector<ResultRow> rows;
        NoisyMap noise;
        bool has_noise = true;  ///< that of all frames is known
    };
    std::map<std::tuple<std::string, std::string, std::string>, Sums> sums_;  ///< by metric, formula, mask
};
