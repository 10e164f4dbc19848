#include "variants/amd_sssr/passes.h"

#include "core/error.h"
#include "core/gbuffer/environment_images.h"
#include "core/gpu/device.h"

#include <cmath>

AmdHistories amd_histories(PassGraph& graph, bool is_float, bool is_float_roughness) {
    const Format radiance = is_float ? Format::rgba32f : Format::rgba16f;
    const Format scalar = is_float ? Format::r32f : Format::r16f;
    const Format average = is_float ? Format::rgba32f : Format::r11g11b10f;
    const glm::uvec2 tiles = (graph.extent() + 7u) / 8u;
    return {.radiance = graph.history("radiance", radiance),
            .variance = graph.history("variance", scalar),
            .sample_count = graph.history("sample_count", scalar),
            .average_radiance = graph.history("average_radiance", average, tiles),
            .roughness = graph.history("roughness", is_float_roughness ? Format::r32f : Format::r8)};
}

float amd_alpha_of_8_bits(float alpha) { return std::floor(alpha * 255.0f + 0.5f) / 255.0f; }  // as lists.glsl

namespace {

bool is_fast_form(const PassGraph& graph, const AmdDenoiserParameters& parameters) {
    return parameters.denoiser_form.is("fast") || (parameters.denoiser_form.is("by_device") && !graph.uses_gpu_forms());
}

/// Each form has shaders of its own. A group of the fast form takes eight tiles, of the others one.
PassGraph::Pass pass_over_tiles(PassGraph& graph, const std::string& name, bool is_fast) {
    return graph.compute("amd_sssr/" + name + (is_fast ? "_fast.comp" : ".comp")).label("amd_sssr/" + name);
}

}  // namespace

AmdWork amd_classify(PassGraph& graph, const GBuffer& gbuffer, const AmdHistories& histories, const Image& confidence,
                     const AmdDenoiserParameters& parameters) {
    const glm::uvec2 extent = graph.extent(), tiles = (extent + 7u) / 8u;
    const AmdWork work{.ray_list = graph.buffer("ray_list", size_t(extent.x) * extent.y * 4),
                       .tile_list = graph.buffer("tile_list", size_t(tiles.x) * tiles.y * 4),
                       .counters = graph.buffer("counters", 16),
                       .indirect_arguments = graph.buffer("indirect_arguments", 36)};
    const bool is_fast = is_fast_form(graph, parameters);
    pass_over_tiles(graph, "classify", is_fast)
        .read(gbuffer.fallback)
        .read(histories.variance.previous)
        .write(histories.radiance.current)
        .write(histories.roughness.current)
        .write(confidence)
        .use(work.ray_list)
        .use(work.tile_list)
        .use(work.counters)
        .dispatch_groups({is_fast ? (tiles.x + 7) / 8 : tiles.x, tiles.y, 1});
    return work;
}

void amd_prepare_arguments(PassGraph& graph, const AmdWork& work) {
    graph.compute("amd_sssr/prepare_arguments.comp")
        .use(work.counters)
        .use(work.indirect_arguments)
        .dispatch_groups({1, 1, 1});
}

void amd_intersect(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters,
                   RayProbe* probe) {
    PassGraph::Pass pass = graph.compute("amd_sssr/intersect.comp");
    pass.read(noise)
        .read(histories.roughness.current)
        .read(gbuffer.lit)
        .read(gbuffer.fallback)
        .write(histories.radiance.current);
    bind_environment(pass, gbuffer).use(work.ray_list).use(work.counters);
    parameters.tracers.run(graph, pass, {"tracer"}, images, probe, 1,
                           [&](PassGraph::Pass& tracing) { tracing.dispatch(work.indirect_arguments); });
}

namespace {

void include_neighborhood(PassGraph::Pass& pass, PassGraph& graph, const AmdDenoiserParameters& parameters) {
    if (parameters.denoiser_form.is("float16") && !graph.device().has_half_floats())
        fail_machine("denoiser_form = float16: the Vulkan device '", graph.device().info().name,
                     "' has no half floats in shaders");
    for (const auto& [name, glsl] : amd_denoiser_includes(parameters)) pass.include(name, glsl);
}

void dispatch_tiles(PassGraph::Pass& pass, const AmdWork& work, bool is_fast) {
    constexpr size_t tile_groups = 12, octet_groups = 24;  // bytes, in AmdWork::indirect_arguments
    pass.use(work.tile_list.as("tile_list"))
        .use(work.counters.as("counters"))
        .dispatch(work.indirect_arguments, is_fast ? octet_groups : tile_groups);
}

Image reprojected_image(PassGraph& graph, const AmdHistories& histories) {
    return graph.image("reprojected_radiance", histories.radiance.current.format);
}

/// The averages that prefilter and resolve read.
Image average_image(const AmdHistories& histories, const AmdDenoiserParameters& parameters) {
    const PassGraph::History& average = histories.average_radiance;
    return (parameters.stale_average ? average.previous : average.current).as("average_radiance");
}

}  // namespace

ShaderIncludes amd_denoiser_includes(const AmdDenoiserParameters& parameters) {
    const bool is_half = parameters.denoiser_form.is("float16");
    return {{"neighborhood",
             std::string("#include \"amd_sssr/denoiser_neighborhood") + (is_half ? "_float16" : "") + ".glsl\"\n"}};
}

std::string amd_denoiser_not_repeatable(const AmdDenoiserParameters& parameters) {
    const bool is_half = parameters.denoiser_form.is("float16");
    const bool is_as_original = is_half || parameters.denoiser_form.is("faithful");
    if (!parameters.denoise || !is_as_original || parameters.barrier_before_average) return {};
    return std::string("denoiser_form = ") + (is_half ? "float16" : "faithful") +
           " without barrier_before_average: a tile's average may overwrite moments that other threads have still to "
           "read";
}

void amd_reproject(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    const Image reprojected = reprojected_image(graph, histories);
    if (parameters.fresh_neighborhood)
        for (const Image& image : {histories.variance.current, histories.sample_count.current}) graph.clear(image, {});
    constexpr float unlisted_average = 64512;  // as in denoiser_tile.glsl
    if (parameters.fresh_neighborhood) graph.clear(histories.average_radiance.current, glm::vec4(unlisted_average));
    const bool is_fast = is_fast_form(graph, parameters);
    PassGraph::Pass pass = pass_over_tiles(graph, "reproject", is_fast);
    if (!is_fast) include_neighborhood(pass, graph, parameters);
    pass.read(histories.radiance.current.as("radiance"))
        .read(histories.roughness.current.as("roughness"))
        .read_linear(histories.radiance.previous.as("previous_radiance"))
        .read_linear(histories.variance.previous.as("previous_variance"))
        .read_linear(histories.sample_count.previous.as("previous_sample_count"))
        .read_linear(histories.roughness.previous.as("previous_roughness"))
        .read_linear(gbuffer.previous_depth)
        .read_linear(gbuffer.previous_normal)
        .write(reprojected)
        .write(histories.variance.current.as("variance"))
        .write(histories.sample_count.current.as("sample_count"))
        .write(histories.average_radiance.current.as("average_radiance"));
    dispatch_tiles(pass, work, is_fast);
}

void amd_prefilter(PassGraph& graph, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    const bool is_fast = is_fast_form(graph, parameters);
    PassGraph::Pass pass = pass_over_tiles(graph, "prefilter", is_fast);
    pass.read(histories.radiance.current.as("radiance"))
        .read(histories.variance.current.as("variance"))
        .read(histories.roughness.current.as("roughness"))
        .read_linear(average_image(histories, parameters))
        .write(histories.radiance.previous.as("prefiltered_radiance"))
        .write(histories.variance.previous.as("prefiltered_variance"));
    dispatch_tiles(pass, work, is_fast);
}

void amd_resolve_temporal(PassGraph& graph, const AmdWork& work, const AmdHistories& histories,
                          const AmdDenoiserParameters& parameters) {
    const PassGraph::History& samples = histories.sample_count;
    const bool is_fast = is_fast_form(graph, parameters);
    PassGraph::Pass pass = pass_over_tiles(graph, "resolve_temporal", is_fast);
    if (!is_fast) include_neighborhood(pass, graph, parameters);
    pass.read(histories.radiance.current.as("traced_radiance"))
        .read(histories.radiance.previous.as("prefiltered_radiance"))
        .read(histories.variance.previous.as("prefiltered_variance"))
        .read(reprojected_image(graph, histories))
        .read((parameters.current_sample_count ? samples.current : samples.previous).as("sample_count"))
        .read(histories.roughness.current.as("roughness"))
        .read_linear(average_image(histories, parameters))
        .write(histories.radiance.current.as("radiance"))
        .write(histories.variance.current.as("variance"));
    dispatch_tiles(pass, work, is_fast);
}

void amd_denoise(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                 const AmdDenoiserParameters& parameters) {
    amd_reproject(graph, gbuffer, work, histories, parameters);
    amd_prefilter(graph, work, histories, parameters);
    amd_resolve_temporal(graph, work, histories, parameters);
}
