#include "variants/tracers/tracer.h"

namespace {

struct ExactScene final : Tracer {
    explicit ExactScene(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.exact_hits = true}; }
};

}  // namespace

TracerEntry exact_scene_tracer() {
    return {.name = "exact_scene",
            .title = "Exact rays, from scene data",
            .source = "ssrlab",
            .description =
                "For comparison: uses scene data, by Embree on the host; a hit is what the screen shows. Its "
                "time is not meaningful.",
            .shader = "tracers/exact_scene/exact_scene.glsl",
            .fits_webgl2 = false,
            .create = [](ParameterSet& params) { return std::make_unique<ExactScene>(params); }};
}
