#include "variants/tracers/tracer.h"

namespace {

struct ExactScene final : Tracer {
    explicit ExactScene(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.exact_hits = true}; }
};

}  // namespace

TracerEntry exact_scene_tracer() {
    return {.name = "exact_scene",
            .title = "What the rays truly meet",
            .source = "ssrlab",
            .description =
                "A yardstick: the scene itself is asked, by Embree on the host; a hit is what the screen shows. Its "
                "time means nothing.",
            .shader = "tracers/exact_scene/exact_scene.glsl",
            .fits_webgl2 = false,
            .create = [](ParameterSet& params) { return std::make_unique<ExactScene>(params); }};
}
