#include "variants/common/blue_noise.h"
#include "variants/common/variant_entry.h"
#include "variants/common/blue_noise_texture.h"
#include "variants/tracers/tracing_variant.h"

/// The four-mode reflection pass of an engine: its documentation of 2026-01-14 is "the document". Parameters have its
/// names, in this project's spelling, and its defaults; those of its two marches are the tracers' `fixed_stride` and
/// `cells`. README.md explains how the document is interpreted, and its errors.
class FourModeSsr final : public TracingVariant {
public:
    FourModeSsr();
    bool depends_on_seed() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers; }
    std::string slot() const { return mode.is("simple_linear") ? "linear_tracer" : "tracer"; }
    bool is_stochastic() const { return mode.is("stochastic") || mode.is("temporal"); }
    Image noise_texture(PassGraph& graph);

    // clang-format off
    Choice mode{params, "mode", "hiz", {"simple_linear", "hiz", "stochastic", "temporal"},
        {"", "simple_linear: a mirror ray by `linear_tracer`; hiz: a mirror ray by `tracer`; stochastic: `num_rays` rays of the GGX "
         "lobe by `tracer`; temporal: the same, blended with the frames before", "the document: 0 to 3, HiZ by default"}};
    Param<float> roughness_fade{params, "roughness_fade", 0.5f, {0.01f, 1.0f},
        {"perceptual", "roughness at which nothing is left of the confidence, which falls to it in proportion", "the document"}};
    Param<float> intensity{params, "intensity", 1.0f, {0.0f, 1.0f}, {"", "factor of the confidence", "the document"}};
    Param<unsigned> num_rays{params, "num_rays", 4, {1, 8},
        {"rays", "of each pixel in the modes stochastic and temporal",
         "the document: 1, 2, 4 and 8 at its qualities Low to Ultra; 2 where it quotes the time of temporal"}};
    Param<float> brdf_bias{params, "brdf_bias", 0.5f, {0.0f, 1.0f},
        {"of the rays", "share that is drawn about GGX normals; the others go anywhere above the surface with one density",
         "the document: a blend of uniform and GGX sampling, 0.5, without a formula; that it is a mixture is ssrlab's"}};
    Choice weights{params, "weights", "none", {"none", "ratio"},
        {"", "of the rays of a pixel in their mean. none: all alike; ratio: the density of the lobe of visible normals over that of "
         "the mixture which they were drawn from, divided by the sum", "none: the document, which names no weight; ratio: ssrlab"}};
    Choice noise = noise_parameter(params, "blue: the document, which names a texture of 64x64 and not how it is used; the sequence is ssrlab's");
    Param<float> sky_depth{params, "sky_depth", 1e-4f, {0.0f, 1.0f},
        {"device depth", "distance from the far plane's up to which a pixel starts no ray; 0: all surfaces do",
         "the document: sky pixels end early, of depths below 1e-4 where the far plane has 0"}};

    // Mode temporal.
    Param<float> temporal_blend{params, "temporal_blend", 0.9f, {0.0f, 0.98f}, {"", "share of the history where nothing moves", "the document"}};
    Param<float> motion_threshold{params, "motion_threshold", 0.01f, {0.001f, 0.1f},
        {"uv", "motion on the screen at which nothing is taken of the history, of which the share falls to it in proportion",
         "the document: the number; the linear fall is ssrlab's"}};
    Choice history_place{params, "history_place", "camera", {"camera", "motion_vectors", "reflection"},
        {"", "what is looked for in the frame before. camera: the surface, as if nothing but the camera moved; motion_vectors: the "
         "surface; reflection: the mirror image of what the rays hit, by that one's motion, as if the surface were flat, and the "
         "surface where it moves itself by half a pixel or more. `motion_threshold` counts the way to it, the longest among the neighbours of the clamp",
         "the document specifies motion vectors, but its algorithm uses the previous camera's matrix; reflection: ssrlab"}};
    Switch neighborhood_clamp{params, "neighborhood_clamp", true,
        {"", "clamps the history to the least and largest of the 3x3 neighbours, each channel and the confidence alone", "the document"}};
    Switch float_histories{params, "float_histories", false,
        {"", "keeps the history in 32 bits in place of 16, whose storing darkens it on devices that truncate", "ssrlab; the document does not say"}};
    Switch reject_other_surfaces{params, "reject_other_surfaces", false,
        {"", "takes nothing of the history where the frame before showed another surface, by 1 % of its distance", "ssrlab; the document has no test"}};
    Switch weigh_by_confidence{params, "weigh_by_confidence", false,
        {"", "blends and clamps colour times confidence, which is what is shown, and not both alone: half a hit and half a miss are "
         "half as much", "ssrlab; the document blends its texture's channels"}};
    // clang-format on
    Tracers tracers;
    std::weak_ptr<ImageStorage> uploaded_noise;
};

namespace {

/// What the document prints of its marches, where the tracers begin without known defects.
nlohmann::json printed_marches() {
    nlohmann::json parameters = {{"fixed_stride.max_steps", 64},
                                 {"fixed_stride.step", "uv"},
                                 {"fixed_stride.reject_towards_camera", true},
                                 {"fixed_stride.front_faces_only", false},
                                 {"fixed_stride.refine", false},
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
    const bool is_linear = mode.is("simple_linear");
    const std::string shader = is_linear ? "four_mode_ssr/trace_linear.comp" : "four_mode_ssr/trace.comp";
    const bool follows_reflections = is_temporal && history_place.is("reflection");
    const Image way =
        graph.image_of("reflection_way", Format::rg16f, follows_reflections ? graph.extent() : glm::uvec2(1));
    tracers.run(graph, graph.compute(shader).read(noise_texture(graph)).write(traced).write(way), {slot()},
                tracers.images(graph, gbuffer.depth, {}, {slot()}), ray_probe, is_stochastic() ? num_rays : 1);
    if (!is_temporal) return {traced, traced, 3};
    const PassGraph::History blended = graph.history("blended", float_histories ? Format::rgba32f : Format::rgba16f);
    graph.compute("four_mode_ssr/blend.comp")
        .read(traced)
        .read(way)
        .read_linear(blended.previous)
        .read(gbuffer.previous_depth)
        .write(blended.current)
        .run();
    return {blended.current, blended.current, 3};
}

/// Where no number is drawn from it, a texel that is never looked at: the shader names the image.
Image FourModeSsr::noise_texture(PassGraph& graph) {
    if (!noise.is("blue") || !depends_on_seed()) return graph.image_black_at_first("blue_noise", Format::rgba8, {1, 1});
    const Image texture = graph.image_of("blue_noise", Format::rgba8, glm::uvec2(blue_noise_texture_width));
    if (uploaded_noise.lock() != texture.storage) {
        graph.upload_rgba8(texture, blue_noise_texture());
        uploaded_noise = texture.storage;
    }
    return texture;
}

bool FourModeSsr::depends_on_seed() const { return is_stochastic() || tracers.needs(slot()).random; }

TracingVariant::Needless FourModeSsr::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "smoother than roughness_fade",
                      .stages = {mode.is("simple_linear") ? "four_mode_ssr/trace_linear" : "four_mode_ssr/trace"}};
    needless.rays = !facts.has_reflective || facts.min_roughness >= roughness_fade;
    needless.specular_readers = needless.stages;
    if (tracers.needs(slot()).nearest_mips > 0) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    if (mode.is("temporal")) {
        needless.stages.push_back("four_mode_ssr/blend");
        if (history_place.is("motion_vectors")) needless.motion_readers = {"four_mode_ssr/blend"};
        if (history_place.is("reflection")) needless.motion_readers = {"four_mode_ssr/trace"};
    }
    return needless;
}

namespace {

/// A row of the document's table "Quality Presets".
nlohmann::json quality(unsigned max_steps, unsigned binary_search_steps, double stride, unsigned num_rays) {
    return {{"fixed_stride.max_steps", max_steps},
            {"cells.max_steps", max_steps},
            {"fixed_stride.binary_search_steps", binary_search_steps},
            {"fixed_stride.stride", stride},
            {"num_rays", num_rays}};
}

/// Corrections of the march, the mean and the temporal mode's history.
nlohmann::json corrections() {
    nlohmann::json parameters = {{"fixed_stride.step", "pixels"},
                                 {"fixed_stride.reject_towards_camera", false},
                                 {"fixed_stride.front_faces_only", true},
                                 {"fixed_stride.refine", true},
                                 {"cells.interval", true},
                                 {"cells.back_faces", "reject"},
                                 {"cells.grazing_fade", 0},
                                 {"weights", "ratio"},
                                 {"brdf_bias", 1},
                                 {"noise", "white"},
                                 {"sky_depth", 0},
                                 {"history_place", "motion_vectors"},
                                 {"reject_other_surfaces", true},
                                 {"weigh_by_confidence", true},
                                 {"repair_inputs", true}};
    for (const std::string march : {"fixed_stride", "cells"})
        parameters.update({{march + ".max_steps", 16384},
                           {march + ".max_distance", 0},
                           {march + ".thickness", 0},
                           {march + ".relative_thickness", 0.01},
                           {march + ".sky_depth", 0},
                           {march + ".clip_to_near_plane", true},
                           {march + ".edge_fade", false},
                           {march + ".distance_fade", false}});
    return parameters;
}

}  // namespace

VariantEntry four_mode_ssr_entry() {
    return {
        .name = "four_mode_ssr",
        .title = "An engine's reflection pass of four modes",
        .source = "documentation of an engine's screen-space reflections (2026-01-14)",
        .description =
            "A fixed stride, a march through a depth pyramid, several rays of the GGX lobe, or these blended over "
            "time; with "
            "the document's fades, and its composite as a study's option.",
        .presets = {{"low", "the document's table: 32 steps, 4 of refinement, stride 2, 1 ray", quality(32, 4, 2, 1)},
                    {"medium", "48 steps, 6 of refinement, stride 1.5, 2 rays", quality(48, 6, 1.5, 2)},
                    {"high", "64 steps, 8 of refinement, stride 1, 4 rays: the document's default",
                     quality(64, 8, 1, 4)},
                    {"ultra", "96 steps, 12 of refinement, stride 0.5, 8 rays", quality(96, 12, 0.5, 8)},
                    {"custom", "all of it user-defined: the defaults, which are those of the document's settings",
                     nlohmann::json::object()},
                    {"corrected", "marches and means without the defects that README.md lists, in any mode",
                     corrections()}},
        .create = [] { return std::make_unique<FourModeSsr>(); },
    };
}
