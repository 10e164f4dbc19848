#include "variants/resolves/resolves.h"

#include "core/error.h"
#include "core/gbuffer/environment_images.h"
#include "core/near_miss.h"

#include <algorithm>

ResolveEntry mean_resolve();
ResolveEntry blur_resolve();
ResolveEntry amd_denoiser_resolve();
ResolveEntry diligent_filters_resolve();
ResolveEntry frostbite_reuse_resolve();
ResolveEntry recurrent_blur_resolve();
ResolveEntry speed_accumulation_resolve();
ResolveEntry cone_mips_resolve();
ResolveEntry ratio_filter_resolve();
ResolveEntry reservoirs_resolve();
ResolveEntry ratio_accumulation_resolve();

std::span<const ResolveEntry> resolve_table() {
    static const std::vector<ResolveEntry> table = {mean_resolve(),
                                                    blur_resolve(),
                                                    amd_denoiser_resolve(),
                                                    diligent_filters_resolve(),
                                                    frostbite_reuse_resolve(),
                                                    recurrent_blur_resolve(),
                                                    speed_accumulation_resolve(),
                                                    cone_mips_resolve(),
                                                    ratio_filter_resolve(),
                                                    reservoirs_resolve(),
                                                    ratio_accumulation_resolve()};
    return table;
}

namespace {

std::vector<std::string> resolve_names() {
    std::vector<std::string> names;
    for (const ResolveEntry& entry : resolve_table()) names.push_back(entry.name);
    return names;
}

}  // namespace

const ResolveEntry& find_resolve(const std::string& name) {
    for (const ResolveEntry& entry : resolve_table())
        if (entry.name == name) return entry;
    fail("unknown resolve '", name, "'", suggestion(name, resolve_names()));
}

bool is_of_chosen_resolve(const ParameterSet& params, const std::string& name) {
    const std::string part = std::ranges::find(params, name, &Parameter::name)->part();
    if (!std::ranges::count(resolve_table(), part, &ResolveEntry::name)) return true;
    return std::ranges::find(params, "resolve", &Parameter::name)->value == part;
}

nlohmann::json RayDrawParameters::values() const {
    return {{"half_resolution", bool(half_resolution)},
            {"max_roughness", float(max_roughness)},
            {"max_rays", unsigned(max_rays)},
            {"lobe", lobe.is("normals") ? "normals" : "visible_normals"},
            {"importance_bias", float(importance_bias)},
            {"max_regenerations", unsigned(max_regenerations)}};
}

namespace {

/// What shaders that include seen.glsl read.
PassGraph::Pass& bind_seen(PassGraph::Pass& pass, const GBuffer& gbuffer, const ResolvedRays& rays) {
    pass.read(rays.color.as("hit_color")).use(rays.traced.directions).use(rays.traced.hits);
    bind_probe(pass, rays);
    return bind_environment(pass, gbuffer);
}

}  // namespace

PassGraph::Pass& bind_probe(PassGraph::Pass& pass, const ResolvedRays& rays) {
    const Image& unread = rays.color;
    return pass.read_linear((rays.probe ? rays.probe->surfaces : unread).as("screen_probe"))
        .read((rays.probe ? rays.probe->nearness : unread).as("screen_probe_nearness"));
}

OwnRays average_own_rays(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) {
    const OwnRays own{graph.image("own_radiance", Format::rgba32f), graph.image("own_length", Format::r32f)};
    PassGraph::Pass pass = graph.compute("resolves/own_rays.comp");
    bind_seen(pass, gbuffer, rays).write(own.radiance).write(own.ray_length).run();
    return own;
}

RayImages ray_images(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) {
    const RayImages images{graph.image("ray_radiance", Format::rgba32f), graph.image("ray_direction", Format::rgba32f)};
    PassGraph::Pass pass = graph.compute("resolves/ray_images.comp");
    bind_seen(pass, gbuffer, rays).write(images.radiance).write(images.direction).run();
    return images;
}

Buffer see_rays(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) {
    const Buffer seen = graph.buffer("seen_rays", rays.traced.directions.size);  // both a vec4 per ray
    const glm::uvec2 screen = graph.extent();
    PassGraph::Pass pass = graph.compute("resolves/see_rays.comp");
    bind_seen(pass, gbuffer, rays).use(seen).run(rays.draw.half_resolution ? (screen + 1u) / 2u : screen);
    return seen;
}

void Resolve::use_own_params(PassGraph& graph, const nlohmann::json& given) {
    params.assign(given);
    graph.set_params(params);
}

Resolves::Resolves(ParameterSet& params, const std::string& initial) : params_(params) {
    Choice(params, "resolve", initial, resolve_names(), {"", "what makes a picture of the rays", "ssrlab"});
    for (const ResolveEntry& entry : resolve_table()) {
        ParameterSet own;
        entry.declare(own);
        for (Parameter p : own) {
            if (std::ranges::count(entry.given, p.name)) continue;
            p.name = entry.name + "." + p.name;
            params.add(p);
        }
    }
}

const ResolveEntry& Resolves::entry() const {
    return find_resolve(std::ranges::find(params_, "resolve", &Parameter::name)->value.get<std::string>());
}

Resolve& Resolves::chosen() {
    const ResolveEntry& entry = this->entry();
    if (chosen_name_ != entry.name) {
        chosen_ = entry.create();
        chosen_name_ = entry.name;
    }
    nlohmann::json values = nlohmann::json::object();
    for (const Parameter& p : params_)
        if (p.part() == entry.name) values[p.name.substr(entry.name.size() + 1)] = p.value;
    chosen_->params.assign(values);
    return *chosen_;
}

Reflections Resolves::run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays, bool has_density) {
    const ResolveEntry& entry = this->entry();
    if (entry.needs_density && !has_density)
        fail("resolve = ", entry.name,
             " weighs rays by the densities with which they were drawn, which mirror rays lack: "
             "draw_directions must be true");
    if (rays.probe && !entry.takes_probe)
        fail("resolve = ", entry.name,
             " has its own way to see what rays met, which does not know misses = probe: take fallback or weight");
    const ParameterSet& params = graph.params();
    const Reflections reflections = chosen().run(graph, gbuffer, rays);
    graph.set_params(params);
    return reflections;
}
