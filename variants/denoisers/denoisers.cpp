#include "variants/denoisers/denoisers.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/common/names.h"

#include <algorithm>

std::span<const DenoiserEntry> denoiser_table() {
    static const std::vector<DenoiserEntry> table = [] {
        std::vector<DenoiserEntry> read;
        for (const char* name :
             {"mean", "blur", "amd_denoiser", "diligent_filters", "frostbite_reuse", "recurrent_blur",
              "speed_accumulation", "cone_mips", "ratio_filter", "reservoirs", "ratio_accumulation"})
            read.push_back(read_denoiser(name));
        return read;
    }();
    return table;
}

namespace {

std::vector<std::string> denoiser_names() { return names_of(denoiser_table(), &DenoiserEntry::name); }

}  // namespace

const DenoiserEntry& find_denoiser(const std::string& name) {
    return find_named(denoiser_table(), name, "unknown denoiser");
}

bool is_of_chosen_denoiser(const ParameterSet& params, const std::string& name) {
    const std::string part = std::ranges::find(params, name, &Parameter::name)->part();
    if (!std::ranges::count(denoiser_table(), part, &DenoiserEntry::name)) return true;
    return value_of(params, "denoiser") == part;
}

Denoisers::Denoisers(ParameterSet& params, const std::string& initial) : params_(params) {
    params.add(choice_of("denoiser", initial, denoiser_names(), "what makes a picture of the rays", "ssrlab"));
    for (const DenoiserEntry& entry : denoiser_table())
        for (Parameter p : entry.passes->parameters) {
            p.name = entry.name + "." + p.name;
            params.add(p);
        }
}

const DenoiserEntry& Denoisers::entry() const {
    return find_denoiser(value_of(params_, "denoiser").get<std::string>());
}

Denoiser& Denoisers::chosen() {
    const DenoiserEntry& entry = this->entry();
    if (!chosen_ || chosen_->entry.name != entry.name) chosen_ = std::make_unique<Denoiser>(entry);
    nlohmann::json values = nlohmann::json::object();
    for (const Parameter& p : params_)
        if (p.part() == entry.name) values[p.name.substr(entry.name.size() + 1)] = p.value;
    chosen_->params.assign(values);
    chosen_->decide(params_);
    return *chosen_;
}

Reflections Denoisers::run(PassList& pass_list, const GBuffer& gbuffer, const DenoisedRays& rays) {
    const DenoiserEntry& entry = this->entry();
    if (entry.needs_density && value_of(params_, "draw_directions") != true)
        fail("denoiser = ", entry.name,
             " weighs rays by the densities with which they were drawn, which mirror rays lack: "
             "draw_directions must be true");
    if (rays.probe && !entry.takes_probe)
        fail("denoiser = ", entry.name,
             " has its own way to see what rays met, which does not know misses = probe: take fallback or weight");
    const ParameterSet& params = pass_list.params();
    const Reflections reflections = chosen().run(pass_list, gbuffer, rays);
    pass_list.set_params(params);
    return reflections;
}
