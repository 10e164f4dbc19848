#include "tests/variants/technique_passes.h"

#include "variants/declared/declared_entry.h"
#include "variants/denoisers/denoisers.h"

const Declaration& declared_technique(const std::string& name) {
    static std::map<std::string, std::shared_ptr<const Declaration>> read;
    std::shared_ptr<const Declaration>& declaration = read[name];
    if (!declaration)
        declaration = read_technique(std::filesystem::path(SSRLAB_SOURCE_DIR) / "variants" / name).declaration;
    return *declaration;
}

Tracers tracers_of(ParameterSet& params, const Declaration& declaration) {
    return {params, declaration.slots, declaration.tracers_source, declaration.tracer_defaults};
}

void add_denoiser(ParameterSet& params, const std::string& denoiser) {
    const Denoiser declared(find_denoiser(denoiser));
    for (const Parameter& parameter : declared.params) params.add(parameter);
}

Reflections denoiser_passes(const std::string& denoiser, PassList& pass_list, const GBuffer& gbuffer,
                            const std::map<std::string, Image>& images) {
    TechniquePasses passes(*find_denoiser(denoiser).passes, pass_list, gbuffer, pass_list.params(), images);
    passes.list.run_all();
    return passes.list.result();
}
