#pragma once
#include "experiments/stability/case_frames.h"
#include "experiments/stability/stage_scan.h"

inline constexpr unsigned stability_seed = 1;  ///< of all random numbers

/// A technique with one set of parameters.
struct StabilityPoint {
    std::string variant, preset;  ///< preset "": the defaults
    nlohmann::json parameters = nlohmann::json::object();
    std::string label() const;  ///< "corrected", "tracer=cells", "default"
};

/// Presets of all techniques, and all tracers but exact_scene, which no screen can have, in the plainest technique.
std::vector<StabilityPoint> stability_points();

/// What one point made of one case.
struct CaseResult {
    HostImage specular;  ///< of the last frame
    std::vector<StageFinding> stages;
    size_t non_finite = 0;         ///< values of all stages
    std::string first_non_finite;  ///< "stage: image"
    size_t spread_pixels = 0;      ///< most pixels of one frame that are not finite though their inputs are
    unsigned spread_frames = 0;    ///< frames with such pixels after the last one with a fault
    // Finite pixels of all frames:
    size_t negative = 0, too_bright = 0;  ///< by radiance: brighter than all light
    float excess = 0.0f;                  ///< the largest radiance, less the brightest light
    size_t bad_confidence = 0;            ///< outside of [0, 1]
    size_t out_of_range() const { return negative + too_bright + bad_confidence; }
    double milliseconds = 0;    ///< the fastest frame's
    std::vector<double> means;  ///< by frame: mean of the specular radiance of pixels that reflect
    std::string refusal;        ///< why it could not be rendered
};

struct CaseOptions {
    unsigned seed = stability_seed;
    bool is_scanned = false;  ///< every image of every stage is looked at, which takes the most of the time
};

/// Renders the frames of `what`, after those of `before`, if there are any, in which the technique saw another size.
CaseResult run_case(Device& device, const StabilityPoint& point, const StabilityCase& what, const CaseFrames& frames,
                    const CaseOptions& options = {}, const CaseFrames* before = nullptr);

/// Squared error over squared truth, of judged pixels that are finite: free of the scale of radiance. None where the
/// truth is black.
std::optional<double> relative_error(const CaseFrames& frames, const HostImage& specular);

/// Whether all three are.
bool is_finite(glm::vec3 v);
