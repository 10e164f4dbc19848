#pragma once
#include "core/host_image.h"
#include "core/ray_probe.h"

/// The choice of the rays that the scene answers in place of a technique's march (parameters exact_rays, exact_share).
///
/// It is made pass by pass and ray by ray, of what each ray shows: the lit colour of this frame where it ends, and the
/// fallback as far as the march is not sure of that. What a technique makes of its rays (reuse, filters, histories, the
/// frame before, the environment along the ray) is not known to it, so that even the oracle is greedy: another choice
/// may leave less error.
class AnsweredRays {
public:
    /// What a choice looks at.
    struct Frame {
        HostImage lit, fallback;  ///< RGB in the first three channels
        HostImage normal;         ///< w perceptual roughness
        HostImage reflectance;    ///< F0 A + F90 B per pixel; empty: not known
        /// RGB, an estimate of what the pixel truly reflects whose noise is independent of that of the reference that
        /// errors are measured against, or the choice would profit from it; empty: not known.
        HostImage true_specular;
        unsigned index = 0, seed = 0;
    };
    explicit AnsweredRays(Frame frame) : frame_(std::move(frame)) {}

    /// Of `exact`, what the rays truly meet, the answers to those that are chosen; outcome_unanswered of all others.
    /// `marched`: where the march ends, in the same order.
    std::vector<ExactHit> choose(const RecordedRays& marched, const std::vector<ExactHit>& exact,
                                 const AskedRays& asked) const;

private:
    Frame frame_;
};
