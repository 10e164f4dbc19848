#include "experiments/bridges/shader_export/described_resources.h"
#include "variants/declared/declared_entry.h"
#include "variants/denoisers/denoisers.h"
#include "variants/registry.h"

namespace {

void add_facts(DeclaredFacts& facts, const Declaration& declaration) {
    for (const DeclaredPass& pass : declaration.passes)
        for (const DeclaredForm& form : pass.forms)
            if (!form.arguments.empty()) facts.arguments[form.shader] = {form.arguments, form.arguments_at};
    for (const DeclaredImage& image : declaration.images)
        if (image.is_kept) facts.kept_images.insert(image.name);
}

}  // namespace

DeclaredFacts declared_facts(const PointConfig& point) {
    DeclaredFacts facts;
    const TechniqueEntry& entry = find_technique(point.technique);
    if (entry.folder) add_facts(facts, *read_technique(entry.folder->path, false).declaration);
    const std::unique_ptr<Technique> technique = make_technique(point.technique, point.parameters, point.preset);
    for (const Parameter& parameter : technique->params)
        if (parameter.name == "denoiser") add_facts(facts, *find_denoiser(parameter.value).passes);
    return facts;
}
