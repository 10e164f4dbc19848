#include "variants/four_mode_ssr/four_mode_ssr.h"

namespace {

/// What the document prints of its marches, where the tracers begin without known defects.
nlohmann::json printed_marches() {
    nlohmann::json parameters = {{"fixed_stride.max_steps", 64},
                                 {"fixed_stride.step", "uv"},
                                 {"fixed_stride.reject_towards_camera", true},
                                 {"fixed_stride.front_faces_only", false},
                                 {"cells.max_steps", 64},
                                 {"cells.interval", false},
                                 {"cells.back_faces", "fade"},
                                 {"cells.grazing_fade", 0.1}};
    for (const std::string march : {"fixed_stride", "cells"})
        parameters.update({{march + ".max_distance", 50},
                           {march + ".thickness", 0.5},
                           {march + ".sky_depth", 1e-4},
                           {march + ".clip_to_near_plane", false},
                           {march + ".edge_fade", true},
                           {march + ".distance_fade", true}});
    return parameters;
}

}  // namespace

FourModeSsr::FourModeSsr()
    : tracers(params,
              {{"tracer", "trace", "cells", "the march of all modes but simple_linear"},
               {"linear_tracer", "linear_trace", "fixed_stride", "the march of the mode simple_linear"}},
              "the document: through a depth pyramid, and with a fixed stride", printed_marches()) {}

Reflections FourModeSsr::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const bool is_temporal = mode.is("temporal");
    const Image traced = graph.image("traced", Format::rgba16f);
    if (is_left_out_) {
        graph.clear(traced, {});
        return {traced, traced, 3};
    }
    const bool is_linear = mode.is("simple_linear");
    const std::string shader = is_linear ? "four_mode_ssr/trace_linear.comp" : "four_mode_ssr/trace.comp";
    tracers.run(graph, graph.compute(shader).write(traced), {slot()},
                tracers.images(graph, gbuffer.depth, {}, {slot()}), ray_probe, is_stochastic() ? num_rays : 1);
    if (!is_temporal) return {traced, traced, 3};
    const PassGraph::History blended = graph.history("blended", Format::rgba16f);
    graph.compute("four_mode_ssr/blend.comp")
        .read(traced)
        .read_linear(blended.previous)
        .read(gbuffer.previous_depth)
        .write(blended.current)
        .run();
    return {blended.current, blended.current, 3};
}

bool FourModeSsr::depends_on_seed() const { return is_stochastic() || tracers.needs(slot()).random; }

TracingVariant::Needless FourModeSsr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "smoother than roughness_fade",
                      .stages = {mode.is("simple_linear") ? "four_mode_ssr/trace_linear" : "four_mode_ssr/trace"}};
    needless.rays = is_left_out_ = !facts.has_reflective || facts.min_roughness >= roughness_fade;
    if (tracers.needs(slot()).nearest_mips > 0) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (mode.is("temporal")) {
        needless.stages.push_back("four_mode_ssr/blend");
        if (history_place.is("motion_vectors")) needless.motion_readers = {"four_mode_ssr/blend"};
    }
    return needless;
}
