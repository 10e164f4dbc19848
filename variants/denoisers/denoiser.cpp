#include "variants/denoisers/denoiser.h"

#include "core/gbuffer/environment_images.h"

#include <algorithm>
#include <cmath>

nlohmann::json given_facts(const ParameterSet& technique) {
    nlohmann::json facts = nlohmann::json::object();
    const nlohmann::json values = technique.values();
    for (const auto& [name, value] : values.items())
        if (name.find('.') == std::string::npos) facts["rays." + name] = value;
    const auto roughness = values.at("max_roughness").get<float>();
    facts["rays.excluded_alpha"] = std::min(std::nextafter(roughness * roughness, 2.0f), 1.0f);
    facts["rays.has_probe"] = values.at("misses") == "probe";
    facts["rays.misses"] = values.at("misses") == "weight" ? "weight" : "fallback";
    return facts;
}

Denoiser::Denoiser(const DenoiserEntry& entry) : entry(entry) {
    for (const Parameter& parameter : entry.passes->parameters) params.add(parameter);
    for (const Parameter& parameter : entry.given) params.add(parameter);
}

void Denoiser::decide(const ParameterSet& technique) {
    const nlohmann::json facts = given_facts(technique);
    nlohmann::json values = nlohmann::json::object();
    if (entry.is_given_as_technique)
        for (const Parameter& given : entry.given)
            if (const auto found = facts.find("rays." + given.name); found != facts.end()) values[given.name] = *found;
    for (const auto& [name, value] : entry.given_values.items())
        values[name] = value.is_string() && facts.contains(value) ? facts[value.get<std::string>()] : value;
    params.assign(values);
}

bool Denoiser::has_read(const std::string& name) const {
    const KnownValues known = this->known();
    const DeclaredResult* result = first_that_holds(entry.passes->results, known);
    return (result && result->radiance == name) ||
           std::ranges::any_of(entry.passes->passes_in_use(known), [&](const DeclaredPass* pass) {
               return std::ranges::count(pass->reads, name, &DeclaredUse::image) > 0 ||
                      std::ranges::count(pass->buffers, name) > 0;
           });
}

std::string Denoiser::stage_of_rays() const {
    if (has_read("own_radiance")) return "denoisers/own_rays";
    if (has_read("ray_radiance")) return "denoisers/ray_images";
    return has_read(seen_rays_buffer) ? "denoisers/see_rays" : "";
}

std::vector<std::string> Denoiser::stages() const {
    std::vector<std::string> stages;
    if (const std::string of_rays = stage_of_rays(); !of_rays.empty()) stages.push_back(of_rays);
    for (const DeclaredPass* pass : entry.passes->passes_in_use(known()))
        if (!std::ranges::count(stages, pass->stage) && pass->cleared.empty()) stages.push_back(pass->stage);
    return stages;
}

bool Denoiser::draws_random_numbers() const { return entry.passes->draws_random_numbers.holds(known()); }

std::string Denoiser::not_repeatable() const { return because(entry.passes->not_repeatable, known()); }

std::vector<std::string> Denoiser::readers_of(const std::string& scene_constant) const {
    std::vector<std::string> stages = entry.passes->readers_of(scene_constant, known());
    if (scene_constant == "scene_has_matte" && stage_of_rays() != "denoisers/see_rays" && !stage_of_rays().empty())
        stages.push_back(stage_of_rays());
    return stages;
}

namespace {

/// A pass that reads rays; shaders that include seen.glsl read all this.
PassList::Pass seeing(PassList& pass_list, const char* shader, const GBuffer& gbuffer, const DenoisedRays& rays,
                      const std::map<std::string, Image>& images) {
    PassList::Pass pass = pass_list.compute(shader);
    pass.read(images.at("hit_color")).use(rays.traced.directions).use(rays.traced.hits);
    pass.read_linear(images.at("screen_probe")).read(images.at("screen_probe_nearness"));
    bind_environment(pass, gbuffer);
    return pass;
}

}  // namespace

Reflections Denoiser::run(PassList& pass_list, const GBuffer& gbuffer, const DenoisedRays& rays) {
    std::map<std::string, Image> images = {
        {"hit_color", rays.color.as("hit_color")},
        {"screen_probe", (rays.probe ? rays.probe->surfaces : rays.color).as("screen_probe")},
        {"screen_probe_nearness", (rays.probe ? rays.probe->nearness : rays.color).as("screen_probe_nearness")}};
    std::map<std::string, Buffer> buffers = {{"directions", rays.traced.directions}, {"hits", rays.traced.hits}};
    const auto add = [&](const char* shader, const std::vector<std::pair<const char*, Format>>& written) {
        PassList::Pass pass = seeing(pass_list, shader, gbuffer, rays, images);
        for (const auto& [name, format] : written) pass.write(images[name] = pass_list.image(name, format));
        pass.run();
    };
    if (has_read("own_radiance"))
        add("denoisers/own_rays.comp", {{"own_radiance", Format::rgba32f}, {"own_length", Format::r32f}});
    if (has_read("ray_radiance"))
        add("denoisers/ray_images.comp", {{"ray_radiance", Format::rgba32f}, {"ray_direction", Format::rgba32f}});
    if (has_read(seen_rays_buffer)) {
        buffers[seen_rays_buffer] = pass_list.buffer(seen_rays_buffer, rays.traced.directions.size);  // a vec4 per ray
        const bool is_half = value_of(rays.technique, "half_resolution").get<bool>();
        seeing(pass_list, "denoisers/see_rays.comp", gbuffer, rays, images)
            .use(buffers[seen_rays_buffer])
            .run(ScreenShare{.divisor = is_half ? 2u : 1u, .rounds_up = true}.of(pass_list.extent()));
    }
    decide(rays.technique);
    pass_list.set_params(params);
    provided_.begin_frame();
    DeclaredPasses passes(*entry.passes, params, known(), {pass_list, gbuffer, provided_}, std::move(images),
                          std::move(buffers));
    passes.run_all();
    return passes.result();
}
