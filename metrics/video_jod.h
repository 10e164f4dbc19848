#pragma once
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"

#include <string>
#include <vector>

inline constexpr const char* video_jod_name = "cvvdp_0_5_6_video";

/// cvvdp_0_5_6_video: how visible the differences between a sequence of frames and the truth are, as ColorVideoVDP
/// scores a video on the display of `cvvdp_0_5_6`. The video is scored against the truth and against both of its
/// halves, for the interval of the truth's noise (jod_interval.h).
class VideoJod {
public:
    /// The frames follow each other at `frames_per_second`. Sizes and rates that cannot be scored fail no study:
    /// score() then has no value, and a note.
    VideoJod(glm::uvec2 extent, const MetricSettings& settings, double frames_per_second);

    /// The truth of one frame: linear, three channels. Its halves are equal to it where it has no noise.
    struct Truth {
        HostImage image, half_a, half_b;
    };

    /// Adds one frame. Frames before the first scored one are what the eye saw earlier; without them the first frame
    /// stands for them. Fails with Error on other sizes or channels, and if an earlier frame follows a scored one.
    void add(const HostImage& test, const Truth& truth, bool is_scored);

    /// The score under the mask `all`, with the 95 % interval of the truth's noise. No value below two frames, or if
    /// more than `most_undefined` of the pixels of all frames are NaN or Inf. No interval if the mean relative_noise()
    /// of the frames is above `most_noise_of_jod`. Call it once.
    TemporalScore score();

    /// JodInterval::draws. Call it after score(); empty without an interval.
    const std::vector<double>& noise() const { return noise_; }

    /// What it holds at 30 frames per second, the usual rate; 1.6 times as much at 60.
    static double bytes_per_pixel() { return 3 * video_bytes_per_pixel(30); }

    static constexpr double most_undefined = 0.01;

private:
    enum Reference { whole, half_a, half_b };

    Viewing viewing_;
    std::vector<CvvdpVideo> videos_;  ///< by Reference; empty if there can be no score
    std::string note_;                ///< why
    std::vector<double> noise_;
    double noise_variance_ = 0;  ///< relative to the truth, summed over scored frames
    size_t pixels_ = 0, undefined_ = 0, scored_ = 0;
};
