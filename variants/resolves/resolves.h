#pragma once
#include "variants/resolves/resolve.h"

#include <span>

/// All resolves, by name.
std::span<const ResolveEntry> resolve_table();

/// Fails with a near miss if there is none of that name.
const ResolveEntry& find_resolve(const std::string& name);

/// As is_of_chosen_tracer() of tracers.h, of resolves.
bool is_of_chosen_resolve(const ParameterSet& params, const std::string& name);

/// The resolves that a technique can use: the parameter `resolve`, which chooses one, and the parameters of all.
class Resolves {
public:
    Resolves(ParameterSet& params, const std::string& initial);

    const ResolveEntry& entry() const;

    /// The chosen one, with the values of its parameters.
    Resolve& chosen();

    /// Adds its passes; the graph then has the technique's parameters again. Fails with Error where rays have no
    /// density and it needs one, and where it does not know the probe.
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays);

private:
    ParameterSet& params_;
    std::unique_ptr<Resolve> chosen_;
};
