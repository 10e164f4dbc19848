#pragma once
#include "core/ray_probe.h"
#include "experiments/study/stability/case_run.h"

#include <set>

/// What one run changes about the arithmetic of a technique.
struct PrecisionWish {
    PassChanges changes;
    std::set<std::string> half_inputs;   ///< members of GBuffer stored in half; all others in float
    bool is_recording = false;           ///< records the rays of the last frame
    std::vector<RecordedRays> replayed;  ///< rays for the last frame, instead of its own
};

/// The content that a stage left in one mip of an image, in the last frame.
struct StageValue {
    std::string stage, image;  ///< label of the pass; the technique's name of the image
    unsigned mip = 0;
    Format format{};
    HostImage values;
};

struct PrecisionRun {
    HostImage specular;                        ///< RGB, of the last frame
    std::vector<std::string> stages;           ///< in the order of their first pass
    std::vector<StageValue> values;            ///< in the order of the passes
    StageValue* find(const StageValue& like);  ///< the value of the same stage, image and mip; null: none
    std::vector<RecordedRays> rays;
};

/// Renders the frames with seed 1. Fails with Error where the technique or the device cannot do `wish`.
PrecisionRun run_precisely(Device& device, const PointConfig& point, const CaseFrames& frames,
                           const PrecisionWish& wish);

/// Distances of values, each |a - b| / max(|a|, |b|): 0 for equal values, 1 where one is 0 or not finite. Values below
/// a millionth of the channel's median count as 0; pairs that are 0 in both do not count.
struct ValueChange {
    double median = 0, p999 = 0;
    double differing = 0;  ///< share of values that differ
};
ValueChange value_change(std::vector<double> differences);
/// Adds the distances in each channel that both images have; both have one size.
void add_differences(const HostImage& a, const HostImage& b, std::vector<double>& differences);
