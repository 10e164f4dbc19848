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
    if (!blurs() || is_sharp_) return {traced, traced, 3};
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

TracingVariant::Needless SimpleSsr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness", .stages = {"simple_ssr/trace"}};
    needless.rays = is_left_out_ = !facts.has_reflective || facts.min_roughness > max_roughness;
    if (tracers.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (previous_frame) needless.stages.insert(needless.stages.begin(), "common/keep_lit");
    is_sharp_ = facts.max_roughness == 0;
    if (blurs())
        for (const char* stage : {"simple_ssr/blur_rows", "simple_ssr/blur_columns"}) {
            needless.stages.push_back(stage);
            if (is_sharp_)
                needless.parts.push_back(
                    {stage, "all that reflects is a mirror", "of mirrors it is no pixel wide", "", false});
        }
    if (previous_frame) needless.motion_readers = {"simple_ssr/trace"};
    return needless;
}
