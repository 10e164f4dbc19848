#pragma once
#include "core/gpu/pass_graph.h"
#include "core/parameters.h"
#include "core/ray_probe.h"

/// What a few exact rays buy: a share of a frame's rays is answered by the scene, as by ray tracing hardware, the others
/// by the march. An answer is what the screen shows of what the ray meets, as of the tracer exact_scene, so that all of
/// them are that tracer.
class AnsweredRays {
public:
    explicit AnsweredRays(ParameterSet& params) : params_(params) {}

    bool are_asked_for() const { return !selector_.is("none") && share_ > 0.0f; }

    /// Of the rays of a pass the answers to those that are chosen; for all others outcome_unanswered. `recorded`: where
    /// the march ends. `exact`: the answers, in the same order. Colours are those of the graph's inputs `lit` and
    /// `fallback`, of this frame; `probe`: which frame that is, and its truth.
    std::vector<ExactHit> choose(PassGraph& graph, const RecordedRays& recorded, std::vector<ExactHit> exact,
                                 const RayProbe& probe) const;

private:
    ParameterSet& params_;
    Choice selector_{params_, "exact_rays", "none", {"none", "oracle", "confidence", "variance", "random"},
        {"", "which of a pass's rays the scene answers in place of the march, which no engine can do without ray "
         "tracing. oracle: those whose answer takes most of the error away; confidence: those of which the march is "
         "least sure, misses first; variance: those whose neighbours' rays, 3x3 pixels, see the most different "
         "luminances; random", "ssrlab"}};
    Param<float> share_{params_, "exact_share", 0.1f, {0.0f, 1.0f},
        {"", "share of the pass's rays that are answered so", "ssrlab"}};
};
