#pragma once
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/left_out_by.h"
#include "experiments/study/measuring/times/timing.h"

#include <functional>

class Device;

/// A study of `points`, each timed over so many frames, lit by the rasteriser.
Config timed_config(const std::vector<PointConfig>& points, unsigned frames);

/// What leaving out changes of someone's images, and what it saves.
struct MeasuredSaving {
    Saving time;                   ///< point "" for "path tracer" and "rasteriser"
    bool keeps_bits = true;        ///< as its parts say
    bool repeats_itself = true;    ///< false: no two runs agree (Technique::not_repeatable()), so nothing is compared
    bool has_same_bits = true;     ///< of the images of every frame; of the path tracer's, of the mean
    float largest_difference = 0;  ///< over the largest value of its image
    bool is_as_said() const;
};

/// The most that the rounding of float32 arithmetic may change where results are stored in halves and fed back: two
/// steps of a half.
inline constexpr float rounding_difference = 2.0f / 1024;

/// Renders the first frames of a shot with a point, with and without what it leaves out.
MeasuredSaving compare_with_all_kept(FrameSource& source, const Shot& shot, const PointConfig& point);

struct MeasuredSavings {
    std::vector<MeasuredSaving> of;
    std::vector<SavedTime> stages;  ///< of techniques
    TimingLoad load;                ///< while they were timed
};
/// Renders the shot with and without what it does not need, lit by the rasteriser: `frames` measured frames of each in
/// turn. Who leaves nothing out is not in the result. `report` gets the share done.
MeasuredSavings measure_savings(Device& device, const Shot& shot, const std::vector<PointConfig>& points,
                                unsigned frames, const std::function<void(double)>& report);
