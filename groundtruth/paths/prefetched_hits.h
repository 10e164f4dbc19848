#pragma once
#include "groundtruth/paths/traced_scene.h"
#include "groundtruth/sampling/lanes.h"

/// Prefetches what the shading of hits will read, while the rays after them are traced. A triangle's record leads to
/// its corners, and these to texels: each hit goes a step further with each hit that follows.
class PrefetchedHits {
public:
    explicit PrefetchedHits(const TracedScene& scene) : scene_(scene), any_varies_(scene.materials.any_varies()) {}

    /// `hit` must stay where it is until finish() returns.
    void add(const RTCHit& hit) {
        hits_[count_++] = &hit;
        step(count_ - 1);
    }
    void finish() { step(count_), step(count_ + 1); }

private:
    void step(int newest) const {
        if (const RTCHit* hit = at(newest)) scene_.geometry.prefetch(hit->instID[0], hit->primID);
        if (!any_varies_) return;
        if (const RTCHit* hit = at(newest - 1)) scene_.materials.prefetch_corners(hit->instID[0], hit->primID);
        if (const RTCHit* hit = at(newest - 2))
            scene_.materials.prefetch_texels(hit->instID[0], hit->primID, hit->u, hit->v);
    }
    const RTCHit* at(int i) const { return i >= 0 && i < count_ ? hits_[i] : nullptr; }

    const TracedScene& scene_;
    const RTCHit* hits_[lane_count];
    int count_ = 0;
    bool any_varies_;
};
