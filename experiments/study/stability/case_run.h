#pragma once
#include "experiments/results/stability/stability_rows.h"
#include "experiments/study/stability/case_frames.h"

inline constexpr unsigned stability_seed = 1;  ///< seed of all random numbers

struct CaseResult : CaseFindings {
    HostImage specular;                ///< of the last frame
    std::vector<StageFinding> stages;  ///< in the order in which they first ran
    ZeroProductCounts zero_products;   ///< of the first frame's passes
    double milliseconds = 0;           ///< time of the fastest frame
    std::vector<double> means;         ///< by frame: mean of the specular radiance of pixels that reflect
};

struct CaseOptions {
    unsigned seed = stability_seed;
    bool is_scanned = false;  ///< scans every image and shader of every stage, which takes most of the time
};

/// Renders the frames of `what`, after those of `before` if it is given, which have another size.
CaseResult run_case(Device& device, const PointConfig& point, const StabilityCase& what, const CaseFrames& frames,
                    const CaseOptions& options = {}, const CaseFrames* before = nullptr);

/// Sum of squared differences of two pictures / sum of the squared truth, over judged pixels that are finite in both:
/// it does not depend on the scale of radiance. None where the truth is black or unknown.
std::optional<double> relative_difference(const CaseFrames& frames, const HostImage& a, const HostImage& b);

/// relative_difference() of the specular picture and its truth.
inline std::optional<double> relative_error(const CaseFrames& frames, const HostImage& specular) {
    return relative_difference(frames, specular, frames.truth);
}

/// Whether all three components are finite.
bool is_finite(glm::vec3 v);
