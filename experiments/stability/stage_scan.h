#pragma once
#include "core/gpu/pass_graph.h"

/// What one image of one stage has held, over the frames that were scanned.
struct StageFinding {
    std::string stage, image;
    size_t nan = 0, infinite = 0;  ///< values, summed over frames
    float largest = 0.0f;          ///< of the finite magnitudes
};

/// Looks at every image that a graph's passes write, when they have written it.
class StageScan {
public:
    /// Of `graph`, which must live longer.
    explicit StageScan(PassGraph& graph) : graph_(graph) {}
    void resume();
    void pause() { graph_.observe({}); }

    /// In the order in which stages first ran.
    const std::vector<StageFinding>& findings() const { return findings_; }
    /// Of all stages.
    size_t non_finite() const;
    /// "stage: image" of the first one in which something is not finite; "" if all is.
    std::string first_non_finite() const;

private:
    void scan(const std::string& stage, const Image& image);

    PassGraph& graph_;
    std::vector<StageFinding> findings_;
};
