#include "variants/amd_sssr/passes.h"

namespace {

/// Each form has shaders of its own. A group of the faithful form denoises one tile, of the fast form eight.
PassGraph::Pass denoiser_pass(PassGraph& graph, const std::string& name, bool is_fast) {
    return graph.compute("amd_sssr/" + name + (is_fast ? "_fast.comp" : ".comp")).label("amd_sssr/" + name);
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

void amd_reproject(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    const Image reprojected = reprojected_image(graph, histories);
    if (parameters.fresh_neighborhood)
        for (const Image& image : {histories.variance.current, histories.sample_count.current}) graph.clear(image, {});
    constexpr float unlisted_average = 64512;  // as in denoiser_tile.glsl
    if (parameters.fresh_neighborhood) graph.clear(histories.average_radiance.current, glm::vec4(unlisted_average));
    const bool is_fast = parameters.denoiser_form.is("fast");
    PassGraph::Pass pass = denoiser_pass(graph, "reproject", is_fast);
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
    const bool is_fast = parameters.denoiser_form.is("fast");
    PassGraph::Pass pass = denoiser_pass(graph, "prefilter", is_fast);
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
    const bool is_fast = parameters.denoiser_form.is("fast");
    PassGraph::Pass pass = denoiser_pass(graph, "resolve_temporal", is_fast);
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
