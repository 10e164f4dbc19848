#pragma once
#include "core/ray_probe.h"
#include "experiments/study/stability/case_run.h"

#include <set>

/// What one run changes about the arithmetic of a technique.
struct PrecisionWish {
    PassChanges changes;
    std::set<std::string> half_inputs;   ///< members of GBuffer that are stored in half; all others in float
    bool is_recording = false;           ///< the rays of the last frame
    std::vector<RecordedRays> replayed;  ///< of the last frame, in place of its own
};

/// What a stage left in one mip of an image in the last frame.
struct StageValue {
    std::string stage, image;  ///< label of the pass; what the technique asked for the image by
    unsigned mip = 0;
    Format format{};
    HostImage values;
};

struct PrecisionRun {
    HostImage specular;                        ///< RGB, of the last frame
    std::vector<std::string> stages;           ///< in the order of their first pass
    std::vector<StageValue> values;            ///< in the order of the passes
    StageValue* find(const StageValue& like);  ///< the same stage's mip of the same image; null: none
    std::vector<RecordedRays> rays;
};

/// Renders the frames with seed 1. Fails with Error where the technique, or the device, cannot.
PrecisionRun run_precisely(Device& device, const PointConfig& point, const CaseFrames& frames,
                           const PrecisionWish& wish);

/// How far values are apart, each as |a - b| / max(|a|, |b|): 0 of equal ones, 1 where one of them is 0 or not finite.
/// What is smaller than a millionth of the channel's median is as good as 0; values that are 0 in both do not count.
struct ValueChange {
    double median = 0, p999 = 0;
    double differing = 0;  ///< share of values
};
ValueChange value_change(std::vector<double> differences);
/// Adds those of each channel that both have; images of one size.
void add_differences(const HostImage& a, const HostImage& b, std::vector<double>& differences);
