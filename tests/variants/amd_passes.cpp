#include "tests/variants/amd_passes.h"

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

namespace {

std::map<std::string, Image> images_of(const AmdHistories& histories) {
    std::map<std::string, Image> images;
    for (const PassGraph::History* history : {&histories.radiance, &histories.variance, &histories.sample_count,
                                              &histories.average_radiance, &histories.roughness})
        for (const Image& side : {history->current, history->previous}) images[side.name] = side;
    return images;
}

std::map<std::string, Buffer> buffers_of(const AmdWork& work) {
    std::map<std::string, Buffer> buffers = {
        {"tile_list", work.tile_list}, {"counters", work.counters}, {"indirect_arguments", work.indirect_arguments}};
    if (work.ray_list.storage) buffers["ray_list"] = work.ray_list;
    return buffers;
}

/// `reprojected`: of the format of the radiance, whatever float_histories is.
void run(PassGraph& graph, const GBuffer& gbuffer, const std::vector<const char*>& stages,
         std::map<std::string, Image> images, const AmdWork& work, const ParameterSet& params) {
    if (images.contains("radiance"))
        images["reprojected_radiance"] = graph.image("reprojected_radiance", images.at("radiance").format);
    TechniquePasses passes(declared_technique("amd_sssr"), graph, gbuffer, params, images, buffers_of(work));
    for (const char* stage : stages) passes.run(stage);
}

}  // namespace

AmdWork amd_classify(PassGraph& graph, const GBuffer& gbuffer, const AmdHistories& histories, const Image& confidence,
                     const AmdDenoiserParameters& parameters) {
    std::map<std::string, Image> images = images_of(histories);
    images["confidence"] = confidence;
    TechniquePasses passes(declared_technique("amd_sssr"), graph, gbuffer, parameters.params, images);
    passes.run("classify");
    return {passes.list.buffer("ray_list"), passes.list.buffer("tile_list"), passes.list.buffer("counters"),
            passes.list.buffer("indirect_arguments")};
}

void amd_prepare_arguments(PassGraph& graph, const AmdWork& work, const AmdDenoiserParameters& parameters) {
    run(graph, {}, {"prepare_arguments"}, {}, work, parameters.params);
}

void amd_intersect(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters,
                   RayProbe* probe) {
    std::map<std::string, Image> given = images_of(histories);
    for (const char* name : {"noise_table", "white_noise", "blue_noise", "golden_noise"}) given[name] = noise;
    TechniquePasses passes(declared_technique("amd_sssr"), graph, gbuffer, parameters.params, given, buffers_of(work),
                           &parameters.tracers, probe);
    passes.list.set_pyramids(images);
    passes.run("intersect");
}

void amd_reproject(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    run(graph, gbuffer, {"reproject"}, images_of(histories), work, parameters.params);
}

void amd_prefilter(PassGraph& graph, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    run(graph, {}, {"prefilter"}, images_of(histories), work, parameters.params);
}

void amd_resolve_temporal(PassGraph& graph, const AmdWork& work, const AmdHistories& histories,
                          const AmdDenoiserParameters& parameters) {
    // Whoever runs this pass alone has made the variance that it writes over.
    run(graph, {}, {"resolve_temporal"}, images_of(histories), work, parameters.params);
}

void amd_denoise(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                 const AmdDenoiserParameters& parameters) {
    run(graph, gbuffer, {"reproject", "prefilter", "resolve_temporal"}, images_of(histories), work, parameters.params);
}
