#include "variants/tracers/tracer.h"

namespace {

struct ExactLayer final : Tracer {
    explicit ExactLayer(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.depth_layers = thickness_from.is("scene")}; }

    // clang-format off
    Choice thickness_from{params, "exact_layer.thickness_from", "scene", {"parameter", "scene"},
        {"", "what is solid behind a visible surface, where a ray enters a pixel behind it. scene: the scene's solid, up to the "
         "back of the surface, which ends the ray as hidden; parameter: exact_layer.relative_thickness, within which the ray "
         "hits it, as in other tracers", "ssrlab"}};
    Param<float> relative_thickness{params, "exact_layer.relative_thickness", 0.02f, {0.0f, 10.0f},
        {"of the depth", "depth behind the visible surface that counts as solid, where scene data is not used", "ssrlab"}};
    // clang-format on
};

}  // namespace

TracerEntry exact_layer_tracer() {
    return {.name = "exact_layer",
            .title = "Exact within one layer of depth",
            .source = "ssrlab",
            .description =
                "For comparison: tests every pixel that the line crosses, treats each as the plane that it shows, "
                "and uses the true thickness of objects.",
            .shader = "tracers/exact_layer/exact_layer.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<ExactLayer>(params); }};
}
