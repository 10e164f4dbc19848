#include "variants/resolves/resolves.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/common/names.h"

#include <algorithm>

std::span<const ResolveEntry> resolve_table() {
    static const std::vector<ResolveEntry> table = [] {
        std::vector<ResolveEntry> read;
        for (const char* name :
             {"mean", "blur", "amd_denoiser", "diligent_filters", "frostbite_reuse", "recurrent_blur",
              "speed_accumulation", "cone_mips", "ratio_filter", "reservoirs", "ratio_accumulation"})
            read.push_back(read_resolve(name));
        return read;
    }();
    return table;
}

namespace {

std::vector<std::string> resolve_names() { return names_of(resolve_table(), &ResolveEntry::name); }

}  // namespace

const ResolveEntry& find_resolve(const std::string& name) {
    for (const ResolveEntry& entry : resolve_table())
        if (entry.name == name) return entry;
    fail("unknown resolve '", name, "'", suggestion(name, resolve_names()));
}

bool is_of_chosen_resolve(const ParameterSet& params, const std::string& name) {
    const std::string part = std::ranges::find(params, name, &Parameter::name)->part();
    if (!std::ranges::count(resolve_table(), part, &ResolveEntry::name)) return true;
    return value_of(params, "resolve") == part;
}

Resolves::Resolves(ParameterSet& params, const std::string& initial) : params_(params) {
    Choice(params, "resolve", initial, resolve_names(), {"", "what makes a picture of the rays", "ssrlab"});
    for (const ResolveEntry& entry : resolve_table())
        for (Parameter p : entry.passes->parameters) {
            p.name = entry.name + "." + p.name;
            params.add(p);
        }
}

const ResolveEntry& Resolves::entry() const { return find_resolve(value_of(params_, "resolve").get<std::string>()); }

Resolve& Resolves::chosen() {
    const ResolveEntry& entry = this->entry();
    if (!chosen_ || chosen_->entry.name != entry.name) chosen_ = std::make_unique<Resolve>(entry);
    nlohmann::json values = nlohmann::json::object();
    for (const Parameter& p : params_)
        if (p.part() == entry.name) values[p.name.substr(entry.name.size() + 1)] = p.value;
    chosen_->params.assign(values);
    chosen_->decide(params_);
    return *chosen_;
}

Reflections Resolves::run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) {
    const ResolveEntry& entry = this->entry();
    if (entry.needs_density && value_of(params_, "draw_directions") != true)
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
