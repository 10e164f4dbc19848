#pragma once
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/measuring/measure.h"

#include <functional>
#include <set>

/// Everything that the frames of a shot are measured against. Poses that look alike share one reference, so a static
/// shot has one for any number of frames.
struct ShotTruth {
    std::map<unsigned, std::shared_ptr<const PoseTruth>> poses;                 ///< by frame
    std::map<std::pair<unsigned, std::optional<unsigned>>, FrameTruth> frames;  ///< by frame and the one before

    std::string probe_hash;  ///< of the reflection probe that results fall back to; "": none

    const PoseTruth& pose(const FrameStep& step) const { return *poses.at(step.frame); }
    const HostImage& lit(const FrameStep& step) const;     ///< empty where no truth is needed
    const FrameTruth* frame(const FrameStep& step) const;  ///< nullptr: nothing of this frame is measured
    bool is_measured() const { return !frames.empty(); }
    std::string content_hash() const;  ///< of all pixels that results depend on
};

/// True for the steps whose change since the step before is compared with the truth's: the first rendering of each pose
/// after the first that is measured, unless only the last is.
bool measures_difference(const Shot& shot, const FrameStep& step);

/// The frames from Shot::config.change on.
bool is_after_change(const Shot& shot, const FrameStep& step);

/// The frames that a result is compared with, by themselves or in what changes from frame to frame; techniques only
/// read the lit colour of the others.
std::set<unsigned> compared_frames(const Shot& shot);

/// Which frames look as a reference does.
struct ReferenceUse {
    bool is_of_last = false, is_of_measured = false;
    bool is_compared = false;  ///< any of compared_frames()
};

/// What is asked of a reference. A target is of the specular light, and so no budget of the lit colour alone.
ReferenceSettings settings_of(const Config& config, ReferenceUse use, bool keep_all);

/// What is to be measured in a shot. `obtain` gives the reference of a frame; it is called once per pose that looks
/// different (of a capture, per file). Fails if the shot names a change after which the scene still moves.
ShotTruth shot_truth(const Shot& shot, const Config& config, FrameStore& store, PassList& pass_list,
                     const std::function<Reference(unsigned frame, ReferenceUse use)>& obtain);

/// Where there is no reference nothing is measured: the lit colour alone, for the frames of `shot`.
ShotTruth truth_of_lit(const Shot& shot, const std::function<HostImage(unsigned frame)>& lit);
