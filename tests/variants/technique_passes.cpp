#include "tests/variants/technique_passes.h"

#include "variants/declared/declared_entry.h"
#include "variants/resolves/resolves.h"

const Technique& declared_technique(const std::string& name) {
    static std::map<std::string, std::shared_ptr<const Technique>> read;
    std::shared_ptr<const Technique>& technique = read[name];
    if (!technique) technique = read_technique(std::filesystem::path(SSRLAB_SOURCE_DIR) / "variants" / name).technique;
    return *technique;
}

Tracers tracers_of(ParameterSet& params, const Technique& technique) {
    return {params, technique.slots, technique.tracers_source, technique.tracer_defaults};
}

void add_resolve(ParameterSet& params, const std::string& resolve) {
    const Resolve declared(find_resolve(resolve));
    for (const Parameter& parameter : declared.params) params.add(parameter);
}

Reflections resolve_passes(const std::string& resolve, PassGraph& graph, const GBuffer& gbuffer,
                           const std::map<std::string, Image>& images) {
    TechniquePasses passes(*find_resolve(resolve).passes, graph, gbuffer, graph.params(), images);
    passes.list.run_all();
    return passes.list.result();
}
