#pragma once
#include "tests/experiments/study/measuring/coverage.h"

/// `none` and the `best` points of linear tracing and of frostbite_sssr in a view, rendered as a study renders them;
/// the last with the seeds 1 to `seeds`. They read the lit colour of `truth`. A room or street (`has_probe`) has a
/// reflection probe to fall back to.
Techniques rendered_techniques(const std::string& scene, glm::uvec2 extent, bool has_probe, const Reference& truth,
                               unsigned seeds);
