#pragma once
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/measuring/measure.h"

#include <functional>
#include <set>

/// Everything that a shot's frames are measured against. Poses that look alike share one reference, so a static shot
/// has one for all frames.
struct ShotTruth {
    std::map<unsigned, std::shared_ptr<const PoseTruth>> poses;                 ///< by frame
    std::map<std::pair<unsigned, std::optional<unsigned>>, FrameTruth> frames;  ///< by frame and previous frame

    std::string probe_hash;  ///< of the reflection probe; "": none

    const PoseTruth& pose(const FrameStep& step) const { return *poses.at(step.frame); }
    const HostImage& lit(const FrameStep& step) const;     ///< empty where no truth is needed
    const FrameTruth* frame(const FrameStep& step) const;  ///< nullptr: nothing of this frame is measured
    bool is_measured() const { return !frames.empty(); }
    std::string content_hash() const;  ///< hash of all pixels that results depend on
};

/// Whether the change since the previous step is compared with the truth's change. True for the first rendering of each
/// pose after the first measured one, unless only the last frame is measured.
bool measures_difference(const Shot& shot, const FrameStep& step);

/// Whether the frames are scored as a video: the study asks for cvvdp_0_5_6, and several frames are measured.
bool measures_video(const ShotConfig& shot, const Config& config);

/// Whether the step's frame is Shot::config.change or later.
bool is_after_change(const Shot& shot, const FrameStep& step);

/// The frames whose results are compared, alone or in their change from frame to frame. Of all others techniques read
/// the lit colour alone.
std::set<unsigned> compared_frames(const Shot& shot);

/// The uses of a reference by the frames that look like it.
struct ReferenceUse {
    bool is_of_last = false, is_of_measured = false;
    bool is_compared = false;  ///< any of compared_frames()
};

/// Settings of a reference with this use. A target noise applies to the specular light, so references of the lit colour
/// alone have none.
ReferenceSettings settings_of(const Config& config, ReferenceUse use, bool keep_all);

/// The truth of a shot. `obtain` gives the reference of a frame; it is called once for each pose that looks different
/// (of a capture: for each file). Fails with Error if the scene still moves after the shot's change.
ShotTruth shot_truth(const Shot& shot, const Config& config, FrameStore& store, PassList& pass_list,
                     const std::function<Reference(unsigned frame, ReferenceUse use)>& obtain);

/// The truth of a shot without references: the lit colour alone; nothing is measured.
ShotTruth truth_of_lit(const Shot& shot, const std::function<HostImage(unsigned frame)>& lit);
