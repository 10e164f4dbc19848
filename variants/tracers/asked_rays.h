#pragma once
#include "core/parameters.h"
#include "core/ray_probe.h"

/// What a few exact rays buy: a share of the rays of each pass that traces is answered by the scene, as by ray tracing
/// hardware, the others by the march. RayProbe::answers of core/ray_probe.h chooses them and knows the answers, which are
/// those of the tracer exact_scene.
class AskedRaysParameters {
public:
    explicit AskedRaysParameters(ParameterSet& params) : params_(params) {}

    bool are_any() const { return !selector_.is("none"); }
    AskedRays value() const { return {params_.values().at("exact_rays"), share_}; }

private:
    ParameterSet& params_;
    Choice selector_{params_, "exact_rays", "none", {"none", "oracle", "confidence", "variance", "random"},
        {"", "which of the rays of each pass the scene answers in place of the march, which no engine can do without ray "
         "tracing. oracle: those whose answer takes most error away, ray by ray; confidence: those of which the march "
         "is least sure, misses first; variance: those whose neighbours' rays see the most different luminances; random",
         "ssrlab"}};
    Param<float> share_{params_, "exact_share", 0.1f, {0.0f, 1.0f},
        {"", "share of the pass's rays that are answered so, with exact_rays", "ssrlab"}};
};
