#pragma once
#include "variants/denoisers/denoiser.h"

#include <span>

/// All denoisers, by name.
std::span<const DenoiserEntry> denoiser_table();

/// Fails with a near miss if there is none of that name.
const DenoiserEntry& find_denoiser(const std::string& name);

/// As is_of_chosen_tracer() of tracers.h, for denoisers.
bool is_of_chosen_denoiser(const ParameterSet& params, const std::string& name);

/// The denoisers that a technique can use: the parameter `denoiser`, which chooses one, and the parameters of all.
class Denoisers {
public:
    Denoisers(ParameterSet& params, const std::string& initial);

    const DenoiserEntry& entry() const;

    /// The chosen denoiser, with the values of its parameters.
    Denoiser& chosen();

    /// Adds the chosen denoiser's passes; the pass_list then has the technique's parameters again. Fails with Error if
    /// the denoiser needs densities and rays have none, or if it cannot read the probe.
    Reflections run(PassList& pass_list, const GBuffer& gbuffer, const DenoisedRays& rays);

private:
    ParameterSet& params_;
    std::unique_ptr<Denoiser> chosen_;
};
