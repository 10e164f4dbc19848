#pragma once
#include "core/host_image.h"
#include "metrics/cvvdp/display.h"
#include "metrics/cvvdp/frame_comparison.h"
#include "metrics/cvvdp/opponent.h"
#include "metrics/plane.h"

#include <functional>

// ColorVideoVDP (Mantiuk et al. 2024, "ColorVideoVDP: A visual difference predictor for image, video and display
// distortions", ACM TOG 43(4)): how visible the differences of two images or videos are.

/// A score, and what it is pooled from.
struct CvvdpScore {
    double jod = 10;                         ///< jod() of pooled_difference()
    std::vector<VisibleDifferences> frames;  ///< of the frames that were pooled
    size_t non_finite = 0;                   ///< pixels, of all frames, that were black because of NaN or Inf
    /// 10 minus the JOD that each pixel's difference would have, the mean over the frames. No share of the score: bands
    /// are added, and nothing is averaged over pixels. Empty unless asked for.
    Plane map;
};

/// Compares stills of one size. Keeps its memory, whose first use takes longer than the comparison.
class CvvdpStills {
public:
    /// Fails with Error if a side is below least_pyramid_side, or a scale is out of range.
    CvvdpStills(glm::uvec2 extent, const Viewing& viewing,
                const CvvdpCalibration& calibration = cvvdp_0_5_6_calibration());

    /// Of images of three channels: codes for an sRGB display, else radiance. A pixel with NaN or Inf in either image
    /// is black in both. Fails with Error on other sizes or channels. Not for several threads at a time.
    CvvdpScore score(const HostImage& reference, const HostImage& test, bool has_map = false);

private:
    glm::uvec2 extent_;
    Viewing viewing_;
    const CvvdpCalibration& calibration_;
    FrameComparison comparison_;
    FrameChannels channels_;
};

/// What the filters over time see before the first frame.
enum class TemporalPadding {
    replicate,  ///< the first frame
    symmetric,  ///< the frames from the second on, in reverse order
    warm_up     ///< nothing: only frames with a full window are pooled
};

inline const std::vector<std::string> temporal_padding_names = {"replicate", "symmetric", "warm_up"};

/// Fails with Error on a name outside temporal_padding_names.
TemporalPadding temporal_padding_named(const std::string& name);
std::string name_of(TemporalPadding padding);

/// What CvvdpVideo holds: the window of its filters, and pyramids. 953 MB were measured for 1920x1080 pixels at 60
/// frames per second. Fails with Error on other rates than filters have.
double video_bytes_per_pixel(double frames_per_second);

/// Compares two videos frame by frame.
class CvvdpVideo {
public:
    /// Fails with Error if the size, the scale, or the frame rate (temporal_filters()) is out of range.
    CvvdpVideo(glm::uvec2 extent, const Viewing& viewing, double frames_per_second, TemporalPadding padding,
               bool has_map = false, const CvvdpCalibration& calibration = cvvdp_0_5_6_calibration());

    /// The next frame of both; see CvvdpStills::score().
    void add(const HostImage& reference, const HostImage& test);

    /// A frame before the first that is scored: the filters see it. Fails with Error after add().
    void add_earlier(const HostImage& reference, const HostImage& test);

    /// The score of all frames. Fails with Error below two frames, or below a full window with
    /// TemporalPadding::warm_up.
    CvvdpScore score();

    unsigned window() const { return unsigned(filters_[0].size()); }  ///< frames that a filter spans

    /// For tests: called with each frame that is pooled, its channels, bands, and map on the scale of
    /// pooled_difference().
    std::function<void(size_t frame, const FrameChannels&, const std::vector<BandStages>&, const FloatPlane& map)>
        on_frame;

private:
    void remember(const HostImage& reference, const HostImage& test);
    void pool(size_t frame);
    size_t shown_at(int64_t frame) const;

    glm::uvec2 extent_;
    Viewing viewing_;
    TemporalPadding padding_;
    bool has_map_;
    const CvvdpCalibration& calibration_;
    PerCvvdpChannel<std::vector<float>> filters_;
    FrameComparison comparison_;
    std::vector<FrameChannels> window_;  ///< opponent channels, [frame modulo window]
    FrameChannels channels_;
    size_t count_ = 0, earlier_ = 0;  ///< frames, and those before the first that is scored
    CvvdpScore score_;
};
