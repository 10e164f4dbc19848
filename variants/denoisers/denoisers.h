#pragma once
#include "variants/denoisers/denoiser.h"

#include <span>

/// All denoisers, by name.
std::span<const DenoiserEntry> denoiser_table();

/// Fails with a near miss if there is none of that name.
const DenoiserEntry& find_denoiser(const std::string& name);

/// As is_of_chosen_tracer() of tracers.h, of denoisers.
bool is_of_chosen_denoiser(const ParameterSet& params, const std::string& name);

/// The denoisers that a technique can use: the parameter `denoiser`, which chooses one, and the parameters of all.
class Denoisers {
public:
    Denoisers(ParameterSet& params, const std::string& initial);

    const DenoiserEntry& entry() const;

    /// The chosen one, with the values of its parameters.
    Denoiser& chosen();

    /// Adds its passes; the pass_list then has the technique's parameters again. Fails with Error where rays have no
    /// density and it needs one, and where it does not know the probe.
    Reflections run(PassList& pass_list, const GBuffer& gbuffer, const DenoisedRays& rays);

private:
    ParameterSet& params_;
    std::unique_ptr<Denoiser> chosen_;
};
