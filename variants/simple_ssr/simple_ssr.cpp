#include "variants/simple_ssr/simple_ssr.h"

Reflections SimpleSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image traced = graph.image("traced", Format::rgba32f);
    if (is_left_out_) {
        graph.clear(traced, {});
        return {traced, traced, 3};
    }
    const Image shown = previous_frame ? lit_.previous(graph, gbuffer.lit) : gbuffer.lit;
    tracers.run(graph, graph.compute("simple_ssr/trace.comp").read(shown.as("shown_lit")).write(traced), {"tracer"},
                tracers.images(graph, gbuffer.depth), ray_probe, draw.is("mirror") ? 1 : rays);
    if (!blurs()) return {traced, traced, 3};
    const Image blurred_rows = graph.image("blurred_rows", Format::rgba32f),
                blurred = graph.image("blurred", Format::rgba32f);
    const auto blur = [&](const Image& from, const Image& to, unsigned axis) {
        graph.compute("simple_ssr/blur.comp")
            .read(from.as("sharp"))
            .write(to.as("result"))
            .set("axis", axis)
            .label(axis == 0 ? "simple_ssr/blur_rows" : "simple_ssr/blur_columns")
            .run();
    };
    blur(traced, blurred_rows, 0);
    blur(blurred_rows, blurred, 1);
    return {blurred, blurred, 3};
}

bool SimpleSsr::depends_on_seed() const { return !draw.is("mirror") || tracers.needs().random; }

std::vector<LeftOut> SimpleSsr::leave_out_passes(const SceneFacts& facts) {
    is_left_out_ = !facts.has_reflective || facts.min_roughness > max_roughness;
    if (!is_left_out_) return {};
    std::vector<std::string> stages = {"simple_ssr/trace"};
    if (tracers.needs_pyramid()) stages.insert(stages.begin(), "common/depth_pyramid");
    if (previous_frame) stages.insert(stages.begin(), "common/keep_lit");
    if (blurs()) stages.insert(stages.end(), {"simple_ssr/blur_rows", "simple_ssr/blur_columns"});
    return left_out_without_rays(facts, "as smooth as max_roughness", stages);
}
