#pragma once
#include "experiments/results/stability/stability_rows.h"
#include "experiments/study/stability/case_frames.h"

inline constexpr unsigned stability_seed = 1;  ///< of all random numbers

struct CaseResult : CaseFindings {
    HostImage specular;                ///< of the last frame
    std::vector<StageFinding> stages;  ///< in the order in which they first ran
    double milliseconds = 0;           ///< the fastest frame's
    std::vector<double> means;         ///< by frame: mean of the specular radiance of pixels that reflect
};

struct CaseOptions {
    unsigned seed = stability_seed;
    bool is_scanned = false;  ///< every image of every stage is looked at, which takes the most of the time
};

/// Renders the frames of `what`, after those of `before`, if there are any, in which the technique saw another size.
CaseResult run_case(Device& device, const PointConfig& point, const StabilityCase& what, const CaseFrames& frames,
                    const CaseOptions& options = {}, const CaseFrames* before = nullptr);

/// Squared difference of two pictures over squared truth, of judged pixels that are finite in both: free of the scale
/// of radiance. None where the truth is black or not known.
std::optional<double> relative_difference(const CaseFrames& frames, const HostImage& a, const HostImage& b);

/// That of the specular picture from its truth.
inline std::optional<double> relative_error(const CaseFrames& frames, const HostImage& specular) {
    return relative_difference(frames, specular, frames.truth);
}

/// Whether all three are.
bool is_finite(glm::vec3 v);
