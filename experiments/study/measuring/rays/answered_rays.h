#pragma once
#include "core/host_image.h"
#include "core/ray_probe.h"

/// Chooses the rays that the scene answers instead of a technique's march (parameters exact_rays, exact_share).
///
/// The choice is made pass by pass and ray by ray, from what each ray shows: this frame's lit colour where it ends, and
/// the fallback as far as the march is unsure. What the technique makes of its rays is unknown to the choice: reuse,
/// filters, histories, the previous frame, the environment along the ray. Even the oracle is therefore greedy: another
/// choice may leave less error.
class AnsweredRays {
public:
    /// The data that a choice depends on.
    struct Frame {
        HostImage lit, fallback;  ///< RGB in the first three channels
        HostImage normal;         ///< w: perceptual roughness
        HostImage reflectance;    ///< F0 A + F90 B per pixel; empty: not known
        /// RGB, an estimate of the pixel's true reflection; empty: unknown. Its noise must be independent of the
        /// reference that errors are measured against, or the choice would profit from it.
        HostImage true_specular;
        unsigned index = 0, seed = 0;
    };
    explicit AnsweredRays(Frame frame) : frame_(std::move(frame)) {}

    /// The elements of `exact` (true hits) for the chosen rays; outcome_unanswered for all others. `marched`: where the
    /// march ends, in the same order.
    std::vector<ExactHit> choose(const RecordedRays& marched, const std::vector<ExactHit>& exact,
                                 const AskedRays& asked) const;

private:
    Frame frame_;
};
