#include "variants/common/variant_entry.h"
#include "variants/variant.h"

/// No screen-space reflections: the fallback everywhere. The line that every metric is read against.
class None final : public Variant {
public:
    Reflections render(PassGraph& graph, const GBuffer& gbuffer) override;
    bool depends_on_seed() const override { return false; }
};

Reflections None::render(PassGraph& graph, const GBuffer&) {
    const Image radiance = graph.image("radiance", Format::rgba32f), confidence = graph.image("confidence", Format::r8);
    graph.clear(radiance, {});
    graph.clear(confidence, {});
    return {radiance, confidence};
}

VariantEntry none_entry() {
    return {
        .name = "none",
        .title = "No screen-space reflections",
        .source = "ssrlab",
        .description = "Confidence 0 everywhere: the fallback alone, the baseline of all techniques.",
        .presets = {},
        .create = [] { return std::make_unique<None>(); },
    };
}
