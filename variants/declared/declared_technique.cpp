#include "variants/declared/declared_entry.h"

#include "core/error.h"
#include "variants/common/lit_history.h"
#include "variants/common/parameter_block.h"
#include "variants/common/repaired_inputs.h"
#include "variants/denoisers/denoisers.h"
#include "variants/passes/declared_passes.h"

#include <algorithm>

namespace {

/// The technique that a technique.json declares.
class DeclaredTechnique final : public Technique {
public:
    explicit DeclaredTechnique(std::shared_ptr<const Declaration> declaration)
        : declaration_(std::move(declaration)), tracers_(own_parameters()) {
        if (!declaration_->denoiser) return;
        denoisers_ = std::make_unique<Denoisers>(params, declaration_->denoiser->initial);
        params.change_defaults(declaration_->denoiser->defaults);
    }

    Reflections render(PassList& pass_list, const GBuffer& gbuffer) override;
    std::vector<LeftOut> leave_out(const SceneFacts& facts) override;

    bool depends_on_seed() const override;
    std::string not_repeatable() const override;
    ShaderIncludes shader_includes() const override;
    bool uses_scene_data() const override { return tracers_.needs().exact_hits; }
    bool needs_depth_layers() const override;
    bool has_gpu_forms() const override {
        return declaration_->names_device || (denoisers_ && denoisers_->entry().passes->names_device);
    }

private:
    Tracers own_parameters() {
        if (declaration_->reads_inputs) add_block(params, "common/repair_inputs.json");
        if (declaration_->denoiser) add_block(params, "denoisers/rays.json");
        const std::vector<Parameter>& own = declaration_->parameters;
        const auto rest = own.begin() + ptrdiff_t(declaration_->parameters_before_tracers);
        std::for_each(own.begin(), rest, [&](const Parameter& parameter) { params.add(parameter); });
        Tracers tracers(params, declaration_->slots, declaration_->tracers_source, declaration_->tracer_defaults);
        std::for_each(rest, own.end(), [&](const Parameter& parameter) { params.add(parameter); });
        return tracers;
    }
    KnownValues known() const { return declaration_->known_values(params, facts_); }
    KnownValues of_any_shot() const { return declaration_->known_values(params); }
    std::vector<std::string> slots_in_use(const KnownValues& known) const {
        return slots_of(declaration_->passes_in_use(known));
    }
    bool repairs_inputs() const { return declaration_->reads_inputs && value_of(params, "repair_inputs") == true; }
    bool has_no_rays(const KnownValues& known) const;
    Reflections run_passes(PassList& pass_list, const GBuffer& gbuffer);
    Reflections run_with_denoiser(PassList& pass_list, const GBuffer& gbuffer, const DeclaredPasses::Around& around);
    /// All stages that begin with its rays, in their order.
    std::vector<std::string> stages() const;
    void add_left_out(std::vector<LeftOut>& left_out, const SceneFacts& facts);
    std::vector<std::string> readers_of(const std::string& scene_constant) const;

    std::shared_ptr<const Declaration> declaration_;
    Tracers tracers_;
    std::unique_ptr<Denoisers> denoisers_;  ///< none without a denoiser
    ProvidedImages provided_;
    std::optional<SceneFacts> facts_;  ///< once they are known
    Constants constants_;              ///< of leave_out()
};

bool DeclaredTechnique::depends_on_seed() const {
    const KnownValues known = of_any_shot();
    if (declaration_->draws_random_numbers.holds(known)) return true;
    if (!denoisers_) {
        const RoughnessLimit* limit = first_that_holds(declaration_->reflects, known);
        const bool has_no_surface = limit && limit->is_excluded && limit->excludes_all_from(0, known);
        return !has_no_surface && tracers_.needs(slots_in_use(known)).random;
    }
    // With half_resolution pixels take turns, in an order of the seed's.
    return tracers_.needs(slots_in_use(known)).random || known.by_name().at("draw_directions") == true ||
           known.by_name().at("half_resolution") == true || denoisers_->chosen().draws_random_numbers();
}

std::string DeclaredTechnique::not_repeatable() const {
    const std::string of_rays = tracers_.not_repeatable(),
                      of_rest = denoisers_ ? denoisers_->chosen().not_repeatable()
                                           : because(declaration_->not_repeatable, of_any_shot());
    return of_rays + (of_rays.empty() || of_rest.empty() ? "" : "; ") + of_rest;
}

ShaderIncludes DeclaredTechnique::shader_includes() const {
    ShaderIncludes includes = tracers_.includes();
    const KnownValues known = of_any_shot();
    for (const DeclaredPass& pass : declaration_->passes)
        for (const DeclaredInclude* include : in_use(pass.includes, &DeclaredInclude::name, known))
            includes[include->name] = "#include \"" + include->file + "\"\n";
    return includes;
}

bool DeclaredTechnique::needs_depth_layers() const {
    const KnownValues known = of_any_shot();
    if (tracers_.needs(slots_in_use(known)).depth_layers) return true;
    for (const DeclaredPass* pass : declaration_->passes_in_use(known))
        for (const DeclaredUse* read : in_use(pass->reads, &DeclaredUse::as, known))
            if (ProvidedImages::is_depth_layer(read->image)) return true;
    return false;
}

Reflections DeclaredTechnique::render(PassList& pass_list, const GBuffer& gbuffer) {
    pass_list.set_constants(constants_);
    const RepairedInputs inputs(pass_list, gbuffer, repairs_inputs() && (!facts_ || facts_->has_faulty_inputs));
    if (facts_ && has_no_rays(known())) {
        const Image nothing = pass_list.image("reflections", Format::rgba16f);
        pass_list.clear(nothing, {});
        return {nothing, nothing, 3};
    }
    return run_passes(pass_list, inputs.gbuffer());
}

Reflections DeclaredTechnique::run_passes(PassList& pass_list, const GBuffer& gbuffer) {
    provided_.begin_frame();
    const DeclaredPasses::Around around{pass_list, gbuffer, provided_, &tracers_, ray_probe};
    if (denoisers_) return run_with_denoiser(pass_list, gbuffer, around);
    DeclaredPasses passes(*declaration_, params, known(), around);
    passes.run_all();
    return passes.result();
}

Reflections DeclaredTechnique::run_with_denoiser(PassList& pass_list, const GBuffer& gbuffer,
                                                 const DeclaredPasses::Around& around) {
    const KnownValues known = this->known();
    const nlohmann::json& values = known.by_name();
    const ScreenShare traced{.divisor = values.at("half_resolution") == true ? 2u : 1u, .rounds_up = true};
    const glm::uvec2 extent = traced.of(pass_list.extent());
    const size_t bytes = size_t(extent.x) * extent.y * values.at("max_rays").get<size_t>() * 16;
    DenoisedRays rays{
        .technique = params,
        .traced = {.directions = pass_list.buffer("directions", bytes), .hits = pass_list.buffer("hits", bytes)},
        .color =
            provided_.image(pass_list, gbuffer, values.at("previous_frame") == true ? "lit_before" : "lit", params),
        .probe = {}};
    if (values.at("misses") == "probe") rays.probe = screen_probe(pass_list, gbuffer);
    DeclaredPasses(*declaration_, params, known, around, {},
                   {{"directions", rays.traced.directions}, {"hits", rays.traced.hits}})
        .run_all();
    return denoisers_->run(pass_list, gbuffer, rays);
}

bool DeclaredTechnique::has_no_rays(const KnownValues& known) const {
    if (!facts_->has_reflective) return true;
    if (denoisers_) {
        const bool answers_rough =
            known.by_name().at("misses") == "probe" && denoisers_->entry().answers_rough_surfaces;
        return facts_->min_roughness > known.by_name().at("max_roughness").get<float>() && !answers_rough;
    }
    const RoughnessLimit* limit = first_that_holds(declaration_->reflects, known);
    return limit && limit->excludes_all_from(facts_->min_roughness, known);
}

std::vector<std::string> DeclaredTechnique::stages() const {
    std::vector<std::string> stages;
    const auto add = [&](const std::string& stage) {
        if (!stage.empty() && !std::ranges::count(stages, stage)) stages.push_back(stage);
    };
    const KnownValues any_shot = of_any_shot();
    const TracerNeeds needs = tracers_.needs(slots_in_use(any_shot));
    if (denoisers_ && any_shot.by_name().at("previous_frame") == true) add(ProvidedImages::stage_of("lit_before"));
    for (const DeclaredPass* pass : declaration_->passes_in_use(any_shot)) {
        for (const DeclaredUse* read : in_use(pass->reads, &DeclaredUse::as, any_shot)) {
            const auto images = in_use(declaration_->images, &DeclaredImage::name, any_shot);
            const auto own = std::ranges::find(images, read->image, &DeclaredImage::name);
            add(ProvidedImages::stage_of(own == images.end() ? read->image : (*own)->same_as));
        }
        if (!pass->tracers.empty() && (needs.nearest_mips > 0 || needs.farthest_mips > 0))
            add(pyramid_maker(*declaration_, any_shot).stage);
        if (pass->cleared.empty()) add(pass->stage);
    }
    if (!denoisers_) return stages;
    if (any_shot.by_name().at("misses") == "probe")
        for (const std::string& stage : screen_probe_stages()) add(stage);
    for (const std::string& stage : denoisers_->chosen().stages()) add(stage);
    return stages;
}

std::vector<std::string> DeclaredTechnique::readers_of(const std::string& scene_constant) const {
    std::vector<std::string> readers;
    const auto add = [&](const std::string& stage) {
        if (!stage.empty() && !std::ranges::count(readers, stage)) readers.push_back(stage);
    };
    const KnownValues known = this->known();
    for (const std::string& stage : declaration_->readers_of(scene_constant, known)) add(stage);
    if (!denoisers_) return readers;
    const Denoiser& denoiser = denoisers_->chosen();
    for (const std::string& stage : denoiser.readers_of(scene_constant)) add(stage);
    const nlohmann::json& values = known.by_name();
    if (scene_constant == "scene_is_still" && values.at("previous_frame") == true) add(denoiser.stage_of_rays());
    if (scene_constant == "scene_has_environment") {
        if (values.at("misses") != "weight") add(denoiser.stage_of_rays());
        if (values.at("misses") == "probe") add(screen_probe_stages().front());
    }
    return readers;
}

std::vector<LeftOut> DeclaredTechnique::leave_out(const SceneFacts& facts) {
    facts_ = facts;
    constants_ = {};
    std::vector<LeftOut> left_out;
    const KnownValues known = this->known();
    if (has_no_rays(known)) {
        const RoughnessLimit* limit = first_that_holds(declaration_->reflects, known);
        const std::string fact =
            !facts.has_reflective
                ? "nothing reflective"
                : "no reflective surface " + (denoisers_ ? "as smooth as max_roughness" : limit->surfaces_within());
        for (const std::string& stage : stages()) left_out.push_back({stage, fact, "no pixel would start a ray"});
    } else {
        add_left_out(left_out, facts);
    }
    if (repairs_inputs() && !facts.has_faulty_inputs)
        left_out.push_back({RepairedInputs::stage, "no faulty inputs", "every pixel would keep its bits"});
    return left_out;
}

/// Where some pixel starts a ray.
void DeclaredTechnique::add_left_out(std::vector<LeftOut>& left_out, const SceneFacts& facts) {
    const KnownValues known = this->known();
    for (const DeclaredPass* pass : declaration_->passes_in_use(of_any_shot())) {
        if (!pass->when.holds(known))
            left_out.push_back({pass->stage, pass->when.failing_member(known),
                                "the technique's declaration runs it for other shots only", "", false});
        for (const DeclaredLeftOut& one : pass->left_out) {
            if (!one.when.holds(known)) continue;
            const auto is_same = [&](const LeftOut& known) { return known.what == pass->stage && one.part.empty(); };
            if (std::ranges::any_of(left_out, is_same)) continue;  // of another pass of the stage
            const bool is_stage = one.part.empty() || one.part.find('/') != std::string::npos;
            left_out.push_back({one.part.empty() ? pass->stage : one.part, one.fact, one.why,
                                is_stage ? "" : pass->stage, one.keeps_bits});
            for (const auto& [name, value] : one.constants) constants_[name] = value;
        }
    }
    const auto add = [&](const char* constant, const LeftOut& without) {
        for (const std::string& stage : readers_of(constant)) {
            left_out.push_back(without);
            left_out.back().stage = stage;
        }
    };
    if (facts.is_still()) add("scene_is_still", {"motion vectors", "nothing moves", "all are 0"});
    if (!facts.has_environment)
        add("scene_has_environment", {"environment", "black environment", "rays that meet nothing see black"});
    if (!facts.has_matte)
        add("scene_has_matte", {"specular factors", "no matte surface", "every surface has a specular term"});
    constants_["scene_has_matte"] = facts.has_matte;
    constants_["scene_is_still"] = facts.is_still();
    constants_["scene_has_environment"] = facts.has_environment;
}

}  // namespace

std::unique_ptr<Technique> make_declared(std::shared_ptr<const Declaration> declaration) {
    return std::make_unique<DeclaredTechnique>(std::move(declaration));
}
