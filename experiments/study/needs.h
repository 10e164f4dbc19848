#pragma once
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/left_out_by.h"
#include "experiments/study/measuring/times/timing.h"

#include <functional>

class Device;

/// A study that times each of `points` over this many frames, lit by the rasteriser.
Config timed_config(const std::vector<PointConfig>& points, unsigned frames);

/// What leaving out saves one renderer, and how its images change.
struct MeasuredSaving {
    Saving time;                   ///< point "" for "path tracer" and "rasteriser"
    bool keeps_bits = true;        ///< all left-out parts claim to keep bits
    bool repeats_itself = true;    ///< false: no two runs agree (Technique::not_repeatable()), so nothing is compared
    bool has_same_bits = true;     ///< every frame's image keeps its bits; for the path tracer the mean
    float largest_difference = 0;  ///< relative to the image's largest value
    bool is_as_said() const;
};

/// Most that float32 rounding may change where results are stored in halves and fed back: two steps of a half.
inline constexpr float rounding_difference = 2.0f / 1024;

/// Renders a shot's first frames with a point twice: with and without what the point leaves out.
MeasuredSaving compare_with_all_kept(FrameSource& source, const Shot& shot, const PointConfig& point);

struct MeasuredSavings {
    std::vector<MeasuredSaving> of;
    std::vector<SavedTime> stages;  ///< of techniques
    TimingLoad load;                ///< while they were timed
};
/// Renders the shot with and without what it does not need, lit by the rasteriser, `frames` measured frames of each in
/// turn. Renderers that leave nothing out are not in the result. `report` gets the share done.
MeasuredSavings measure_savings(Device& device, const Shot& shot, const std::vector<PointConfig>& points,
                                unsigned frames, const std::function<void(double)>& report);
