#pragma once
#include "core/gbuffer/prefiltered_environment.h"
#include "groundtruth/paths/traced_scene.h"

/// What a technique's result is composited with, of the truth ladder: FirstHit::reflectance and fallback.
class CompositeTerms {
public:
    /// `scene` must outlive them.
    explicit CompositeTerms(const TracedScene& scene);

    void add_to(FirstHit& hit) const;

private:
    const TracedScene& scene_;
    PrefilteredEnvironment prefiltered_;
    const HostImage& split_sum_;
};
