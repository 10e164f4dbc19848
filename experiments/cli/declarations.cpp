#include "experiments/cli/declarations.h"

#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_images.h"
#include "core/gbuffer/gbuffer_layers.h"
#include "core/gpu/format.h"
#include "core/list_text.h"
#include "core/scene/scene_family.h"
#include "experiments/results/files/image_layers.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/results_schema.h"
#include "experiments/study/config/config.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/denoisers/denoisers.h"
#include "variants/passes/provided_images.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

namespace {

using nlohmann::json;

/// Arguments and options without --help. `value` is what --help shows: a name or a type, and what is checked, as
/// "DIR:DIR" or "INT in [1 - 64]"; empty for a flag.
json options_of(const CLI::App& command) {
    json options = json::array();
    for (const CLI::Option* option : command.get_options()) {
        if (option == command.get_help_ptr()) continue;
        json excluded = json::array();
        for (const CLI::Option* other : option->get_excludes()) excluded.push_back(other->get_name());
        options.push_back({{"name", option->get_name(option->get_positional())},
                           {"value", option->get_type_size() == 0 ? "" : option->get_type_name()},
                           {"required", option->get_required()},
                           {"several", option->get_expected_max() == CLI::detail::expected_max_vector_size},
                           {"default", option->get_default_str()},
                           {"excludes", excluded},
                           {"meaning", option->get_description()}});
    }
    return options;
}

json commands_of(const CLI::App& app) {
    json commands = json::array();
    for (const CLI::App* command : app.get_subcommands({}))
        commands.push_back({{"name", command->get_name()},
                            {"group", command->get_group()},
                            {"meaning", command->get_description()},
                            {"example", command->get_footer()},
                            {"options", options_of(*command)},
                            {"has_script", command->get_prefix_command()}});
    return commands;
}

template <class Parameters>
json parameters_of(const Parameters& parameters) {
    json all = json::array();
    for (const Parameter& p : parameters)
        all.push_back({{"name", p.name},
                       {"part", p.part()},
                       {"default", p.initial},
                       {"range", p.range_text()},
                       {"unit", p.unit},
                       {"meaning", p.doc},
                       {"source", p.source}});
    return all;
}

template <class Entry>
json page_of(const Entry& entry) {
    return {{"name", entry.name}, {"title", entry.title}, {"source", entry.source}, {"description", entry.description}};
}

json techniques() {
    json all = json::array();
    for (const TechniqueEntry& entry : technique_table()) {
        json page = page_of(entry);
        page["limits"] = limits_text(entry.limits);
        page["presets"] = json::array();
        page["parameters"] = parameters_of(make_technique(entry.name)->params);
        for (const Preset& preset : entry.presets)
            page["presets"].push_back(
                {{"name", preset.name}, {"meaning", preset.meaning}, {"parameters", preset.parameters}});
        all.push_back(page);
    }
    return all;
}

json tracers() {
    json all = json::array();
    for (const TracerEntry& entry : tracer_table()) {
        json page = page_of(entry);
        page["part"] = entry.part;
        page["fits_webgl2"] = entry.fits_webgl2;
        page["parameters"] = parameters_of(entry.parameters);
        all.push_back(page);
    }
    return all;
}

json denoisers() {
    json all = json::array();
    for (const DenoiserEntry& entry : denoiser_table()) {
        json page = page_of(entry);
        page["needs_density"] = entry.needs_density;
        page["parameters"] = parameters_of(entry.passes->parameters);
        all.push_back(page);
    }
    return all;
}

json metrics() {
    const json descriptions = metric_descriptions();
    json all = json::object();
    for (const std::string& name : metric_names()) all["images"].push_back(name);
    for (const TemporalMetric& metric : temporal_metrics()) all["sequences"].push_back(metric.name);
    all["described"] = descriptions;
    return all;
}

json families() {
    json all = json::array();
    for (const SceneFamily& family : scene_families()) all.push_back({{"name", family.name}, {"about", family.about}});
    return all;
}

json shader_images() {
    json gbuffer = json::array(), provided = json::array();
    for (const GBufferImage& image : gbuffer_images())
        gbuffer.push_back({{"name", image.name},
                           {"format", name_of(image.exact)},
                           {"packed", name_of(image.packed)},
                           {"meaning", image.meaning},
                           {"background", image.background}});
    for (const ProvidedImage& image : ProvidedImages::described())
        provided.push_back({{"name", image.name}, {"format", image.format}, {"meaning", image.meaning}});
    return {{"gbuffer", gbuffer}, {"provided", provided}};
}

json capture_files() {
    json layers = json::array(), keys = json::array();
    for (const GBufferLayer& layer : gbuffer_layers())
        layers.push_back({{"name", layer.name},
                          {"channels", layer.channels},
                          {"type", layer.type == PixelType::uint32 ? "uint" : "float"},
                          {"meaning", layer.meaning},
                          {"if_absent", layer.if_absent}});
    for (const CameraFileKey& key : camera_file_keys())
        keys.push_back(
            {{"name", key.name}, {"values", key.values}, {"default", key.initial}, {"meaning", key.meaning}});
    return {{"layers", layers}, {"camera", keys}};
}

json described(std::span<const DescribedLayer> layers) {
    json all = json::array();
    for (const DescribedLayer& layer : layers)
        all.push_back({{"name", layer.name}, {"channels", layer.channels}, {"meaning", layer.meaning}});
    return all;
}

json image_layers() {
    const ReferenceLayers of_references = reference_layers();
    return {{"estimates", described(of_references.estimates)},
            {"others", described(of_references.others)},
            {"rungs", described(of_references.rungs)},
            {"of_rungs", described(of_references.of_rungs)},
            {"results", described(result_image_kinds())}};
}

}  // namespace

json declarations(const CLI::App& app) {
    return {{"commands", commands_of(app)},
            {"keys", key_descriptions()},
            {"columns", results_schema({})["resources"]},
            {"techniques", techniques()},
            {"tracers", tracers()},
            {"denoisers", denoisers()},
            {"metrics", metrics()},
            {"scene_families", families()},
            {"shader_images", shader_images()},
            {"capture_files", capture_files()},
            {"image_layers", image_layers()}};
}
