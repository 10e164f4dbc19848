#pragma once
#include "experiments/stability/case_frames.h"

inline constexpr unsigned stability_seed = 1;  ///< of all random numbers

/// What one image of one stage has held, over the frames that were looked at.
struct StageFinding {
    std::string stage, image;
    size_t nan = 0, infinite = 0;  ///< values, summed over frames
    double largest = 0;            ///< of the finite magnitudes
};

/// What is wrong with what one point made of one case.
struct CaseFindings {
    size_t non_finite = 0;         ///< values of all stages
    std::string first_non_finite;  ///< "stage: image"
    size_t spread_pixels = 0;      ///< most pixels of one frame that are not finite though their inputs are
    unsigned spread_frames = 0;    ///< frames with such pixels after the last one with a fault
    // Finite pixels of all frames:
    size_t negative = 0, too_bright = 0;  ///< by radiance: brighter than all light
    double excess = 0;                    ///< the largest radiance, less the brightest light
    size_t bad_confidence = 0;            ///< outside of [0, 1]
    std::string refusal;                  ///< why it could not be rendered

    size_t out_of_range() const { return negative + too_bright + bad_confidence; }
};

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
CaseResult run_case(Device& device, const VariantConfig& point, const StabilityCase& what, const CaseFrames& frames,
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
