#pragma once
#include "core/error.h"
#include "variants/common/parameter_block.h"
#include "variants/passes/declared_passes.h"

/// What ssrlab's own technique of that name declares, for tests that run its passes one by one.
const Declaration& declared_technique(const std::string& name);

/// The tracers of a technique, with its parameters of them.
Tracers tracers_of(ParameterSet& params, const Declaration& declaration);

/// A parameter that reads like its value.
struct ParameterView {
    const ParameterSet& params;
    std::string name;

    const nlohmann::json& value() const { return value_of(params, name); }
    bool is(const char* choice) const { return value() == choice; }
    template <class T>
    operator T() const {
        return value().get<T>();
    }
};

/// Adds the parameters that a denoiser's shaders name.
void add_denoiser(ParameterSet& params, const std::string& denoiser);

/// The denoiser's passes on what it is given in `images`, with the pass_list's parameters.
Reflections denoiser_passes(const std::string& denoiser, PassList& pass_list, const GBuffer& gbuffer,
                            const std::map<std::string, Image>& images);

/// One frame of a technique's passes on images of the test's own.
struct TechniquePasses {
    TechniquePasses(const Declaration& declaration, PassList& pass_list, const GBuffer& gbuffer,
                    const ParameterSet& params, std::map<std::string, Image> images = {},
                    std::map<std::string, Buffer> buffers = {}, const Tracers* tracers = nullptr,
                    RayProbe* probe = nullptr)
        : declaration(declaration),
          list(declaration, params, declaration.known_values(params), {pass_list, gbuffer, provided, tracers, probe},
               std::move(images), std::move(buffers)) {}

    /// Those of this stage, "mask" of diligent_ssr/mask.
    void run(const std::string& stage) {
        unsigned count = 0;
        for (const DeclaredPass* pass : declaration.passes_in_use(list.known()))
            if (pass->stage == declaration.name + "/" + stage) list.run(*pass), ++count;
        if (count == 0) fail("no pass of the stage ", stage);
    }
    /// Of the image or buffer.
    void clear(const std::string& cleared) {
        for (const DeclaredPass* pass : declaration.passes_in_use(list.known()))
            if (pass->cleared == cleared) list.run(*pass);
    }
    Image image(const std::string& name) { return list.image(name); }

    const Declaration& declaration;
    ProvidedImages provided;
    DeclaredPasses list;
};
