#include "variants/common/variant_entry.h"
#include "variants/tracers/tracing_variant.h"

/// One mirror ray per pixel, and the lit colour where it ends: the plainest technique. Its own tracer is McGuire & Mara
/// 2014, "Efficient GPU Screen-Space Ray Tracing", Journal of Computer Graphics Techniques 3(4). The image `hit` of the
/// graph (rgba32f) keeps where each ray ended: uv on the un-jittered screen, distance (m), confidence, 0 of misses.
class McGuireDda final : public TracingVariant {
public:
    bool depends_on_seed() const override { return tracers.needs().random; }

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers; }

    // clang-format off
    Switch bilinear_color{params, "bilinear_color", false,
        {"", "filters the colour at the hit bilinearly; otherwise it is that of the tested pixel", "ssrlab"}};
    Param<float> max_roughness{params, "max_roughness", 0.6f, {0.0f, 1.0f},
        {"perceptual", "rougher surfaces are left to the fallback", "ssrlab; the paper traces mirrors only"}};
    Switch trace_inward_rays{params, "trace_inward_rays", true,
        {"", "also traces mirror rays that shading normals turn below the geometric surface",
         "McGuire & Mara 2014 do not distinguish them"}};
    // clang-format on
    Tracers tracers{
        params, {{"tracer", "trace", "dda", "the march that finds what a ray meets"}}, "McGuire & Mara 2014: dda"};
};

Reflections McGuireDda::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image hit = graph.image("hit", Format::rgba32f);
    const Image radiance = graph.image("radiance", Format::rgba32f);
    const Image confidence = graph.image("confidence", Format::r8);
    tracers.run(graph, graph.compute("mcguire_dda/trace.comp").write(hit), {"tracer"},
                tracers.images(graph, gbuffer.depth), ray_probe);
    graph.compute("mcguire_dda/shade.comp")
        .read(hit)
        .read(gbuffer.lit, {.is_linear = bilinear_color})
        .write(radiance)
        .write(confidence)
        .run();
    return {radiance, confidence};
}

TracingVariant::Needless McGuireDda::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness",
                      .stages = {"mcguire_dda/trace", "mcguire_dda/shade"}};
    needless.rays = !facts.has_reflective || facts.min_roughness > max_roughness;
    needless.specular_readers = {"mcguire_dda/trace"};
    if (tracers.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    return needless;
}

VariantEntry mcguire_dda_entry() {
    return {
        .name = "mcguire_dda",
        .title = "Screen-space ray tracing by a perspective-correct DDA",
        .source = "McGuire & Mara 2014, Efficient GPU Screen-Space Ray Tracing, JCGT 3(4)",
        .description =
            "One mirror ray per pixel, walked pixel by pixel along its line on the screen until it passes "
            "behind a surface.",
        .presets = {{"published",
                     "the first interval starts at the ray's origin, as in the paper",
                     {{"dda.interval_from_origin", true}}},
                    {"coarse",
                     "every fourth pixel, dithered, with the authors' refinement",
                     {{"dda.stride", 4}, {"dda.checkerboard", true}, {"dda.refine", true}}},
                    {"any_scale",
                     "thickness as a share of the depth, for scenes of any size",
                     {{"dda.thickness", 0.0}, {"dda.relative_thickness", 0.02}}},
                    {"best",
                     "the least error that a search before `ssrlab tune` found (commit 5cf9fef)",
                     {{"bilinear_color", true},
                      {"dda.clip_to_viewport", false},
                      {"max_roughness", 0.2},
                      {"repair_inputs", true}}}},
        .create = [] { return std::make_unique<McGuireDda>(); },
    };
}
