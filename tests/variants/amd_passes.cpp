#include "tests/variants/amd_passes.h"

AmdHistories amd_histories(PassList& pass_list, bool is_float, bool is_float_roughness) {
    const Format radiance = is_float ? Format::rgba32f : Format::rgba16f;
    const Format scalar = is_float ? Format::r32f : Format::r16f;
    const Format average = is_float ? Format::rgba32f : Format::r11g11b10f;
    const glm::uvec2 tiles = (pass_list.extent() + 7u) / 8u;
    return {.radiance = pass_list.history("radiance", radiance),
            .variance = pass_list.history("variance", scalar),
            .sample_count = pass_list.history("sample_count", scalar),
            .average_radiance = pass_list.history("average_radiance", average, tiles),
            .roughness = pass_list.history("roughness", is_float_roughness ? Format::r32f : Format::r8)};
}

namespace {

std::map<std::string, Image> images_of(const AmdHistories& histories) {
    std::map<std::string, Image> images;
    for (const PassList::History* history : {&histories.radiance, &histories.variance, &histories.sample_count,
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
void run(PassList& pass_list, const GBuffer& gbuffer, const std::vector<const char*>& stages,
         std::map<std::string, Image> images, const AmdWork& work, const ParameterSet& params) {
    if (images.contains("radiance"))
        images["reprojected_radiance"] = pass_list.image("reprojected_radiance", images.at("radiance").format);
    TechniquePasses passes(declared_technique("amd_sssr"), pass_list, gbuffer, params, images, buffers_of(work));
    for (const char* stage : stages) passes.run(stage);
}

}  // namespace

AmdWork amd_classify(PassList& pass_list, const GBuffer& gbuffer, const AmdHistories& histories,
                     const Image& confidence, const AmdDenoiserParameters& parameters) {
    std::map<std::string, Image> images = images_of(histories);
    images["confidence"] = confidence;
    TechniquePasses passes(declared_technique("amd_sssr"), pass_list, gbuffer, parameters.params, images);
    passes.run("classify");
    return {passes.list.buffer("ray_list"), passes.list.buffer("tile_list"), passes.list.buffer("counters"),
            passes.list.buffer("indirect_arguments")};
}

void amd_prepare_arguments(PassList& pass_list, const AmdWork& work, const AmdDenoiserParameters& parameters) {
    run(pass_list, {}, {"prepare_arguments"}, {}, work, parameters.params);
}

void amd_intersect(PassList& pass_list, const GBuffer& gbuffer, const Tracers::Images& images, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters,
                   RayProbe* probe) {
    std::map<std::string, Image> given = images_of(histories);
    for (const char* name : {"noise_table", "white_noise", "blue_noise", "golden_noise"}) given[name] = noise;
    TechniquePasses passes(declared_technique("amd_sssr"), pass_list, gbuffer, parameters.params, given,
                           buffers_of(work), &parameters.tracers, probe);
    passes.list.set_pyramids(images);
    passes.run("intersect");
}

void amd_reproject(PassList& pass_list, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    run(pass_list, gbuffer, {"reproject"}, images_of(histories), work, parameters.params);
}

void amd_prefilter(PassList& pass_list, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters) {
    run(pass_list, {}, {"prefilter"}, images_of(histories), work, parameters.params);
}

void amd_resolve_temporal(PassList& pass_list, const AmdWork& work, const AmdHistories& histories,
                          const AmdDenoiserParameters& parameters) {
    // Whoever runs this pass alone has made the variance that it writes over.
    run(pass_list, {}, {"resolve_temporal"}, images_of(histories), work, parameters.params);
}

void amd_denoise(PassList& pass_list, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                 const AmdDenoiserParameters& parameters) {
    run(pass_list, gbuffer, {"reproject", "prefilter", "resolve_temporal"}, images_of(histories), work,
        parameters.params);
}
