#include "core/error.h"
#include "core/gbuffer/environment_images.h"
#include "variants/declared/provided_images.h"
#include "variants/declared/technique.h"
#include "variants/resolves/ray_inputs.h"

#include <algorithm>

namespace {

/// What one frame runs.
struct Frame {
    PassGraph& graph;
    const GBuffer& gbuffer;
    KnownValues known;
    std::map<std::string, Image> images;
    std::map<std::string, Buffer> buffers;
    std::optional<Tracers::Images> pyramids;  ///< of its tracers, made where the first pass traces
    std::optional<ResolvedRays> rays;         ///< where it has a resolve
};

/// The technique that a technique.json declares.
class DeclaredTechnique final : public TracingVariant {
public:
    explicit DeclaredTechnique(std::shared_ptr<const Technique> technique)
        : technique_(std::move(technique)),
          inputs_(technique_->resolve ? std::make_unique<RayInputs>(params) : nullptr),
          tracers_(own_parameters()),
          resolves_(technique_->resolve ? std::make_unique<Resolves>(params, technique_->resolve->initial) : nullptr) {
        if (technique_->resolve) params.change_defaults(technique_->resolve->defaults);
    }

    bool depends_on_seed() const override {
        const KnownValues known(params);
        return technique_->draws_random_numbers.holds(known) || tracers_.needs(slots_in_use(known)).random ||
               (inputs_ && inputs_->depends_on_seed(*resolves_));
    }
    std::string not_repeatable() const override {
        return inputs_ ? inputs_->not_repeatable(tracers_, *resolves_) : tracers_.not_repeatable();
    }
    bool needs_depth_layers() const override;

private:
    Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) override;
    Needless find_needless(const SceneFacts& facts) override;
    const Tracers& chosen_tracers() const override { return tracers_; }

    Tracers own_parameters() {
        for (const Parameter& parameter : technique_->parameters) params.add(parameter);
        return {params, technique_->slots, technique_->tracers_source, technique_->tracer_defaults};
    }
    std::vector<const DeclaredPass*> passes_in_use(const KnownValues& known) const;
    std::vector<std::string> slots_in_use(const KnownValues& known) const;

    void make_images(Frame& frame) const;
    void make_rays(Frame& frame);
    Image image_of(Frame& frame, const DeclaredUse& use);
    void run(Frame& frame, const DeclaredPass& declared);
    void run_with_tracers(Frame& frame, const DeclaredPass& declared, const PassGraph::Pass& pass);
    unsigned rays_of(const DeclaredPass& pass) const;

    std::shared_ptr<const Technique> technique_;
    std::unique_ptr<RayInputs> inputs_;  ///< none without a resolve
    Tracers tracers_;
    std::unique_ptr<Resolves> resolves_;
    ProvidedImages provided_;
    std::optional<SceneFacts> facts_;  ///< once they are known
};

std::vector<const DeclaredPass*> DeclaredTechnique::passes_in_use(const KnownValues& known) const {
    std::vector<const DeclaredPass*> passes;
    for (const DeclaredPass& pass : technique_->passes)
        if (pass.when.holds(known)) passes.push_back(&pass);
    return passes;
}

std::vector<std::string> DeclaredTechnique::slots_in_use(const KnownValues& known) const {
    std::vector<std::string> slots;
    for (const DeclaredPass* pass : passes_in_use(known))
        for (const std::string& slot : pass->tracers)
            if (!std::ranges::count(slots, slot)) slots.push_back(slot);
    return slots;
}

bool DeclaredTechnique::needs_depth_layers() const {
    const KnownValues known(params);
    if (tracers_.needs(slots_in_use(known)).depth_layers) return true;
    for (const DeclaredPass* pass : passes_in_use(known))
        for (const DeclaredUse* read : in_use(pass->reads, &DeclaredUse::as, known))
            if (ProvidedImages::is_depth_layer(read->image)) return true;
    return false;
}

Reflections DeclaredTechnique::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    Frame frame{.graph = graph,
                .gbuffer = gbuffer,
                .known = facts_ ? KnownValues(params, *facts_) : KnownValues(params),
                .images = {},
                .buffers = {},
                .pyramids = {},
                .rays = {}};
    provided_.begin_frame();
    make_images(frame);
    if (inputs_) make_rays(frame);
    for (const DeclaredPass* pass : passes_in_use(frame.known)) run(frame, *pass);
    if (inputs_) return inputs_->show(graph, gbuffer, *frame.rays, *resolves_);
    for (const DeclaredResult& result : technique_->results)
        if (result.when.holds(frame.known))
            return {frame.images.at(result.radiance), frame.images.at(result.confidence), result.channel};
    fail("technique '", technique_->name, "' has no result with these values of its parameters");
}

void DeclaredTechnique::make_images(Frame& frame) const {
    for (const DeclaredImage* image : in_use(technique_->images, &DeclaredImage::name, frame.known)) {
        const glm::uvec2 extent = image->extent(frame.graph.extent());
        if (image->has_history) {
            const PassGraph::History history = frame.graph.history(image->name, image->format, extent);
            frame.images[image->name] = history.current, frame.images[history.previous.name] = history.previous;
        } else {
            frame.images[image->name] = frame.graph.image_of(image->name, image->format, extent, image->mips);
        }
    }
    const size_t pixels = size_t(frame.graph.extent().x) * frame.graph.extent().y;
    for (const DeclaredBuffer* buffer : in_use(technique_->buffers, &DeclaredBuffer::name, frame.known))
        frame.buffers[buffer->name] =
            frame.graph.buffer(buffer->name, buffer->bytes + pixels * buffer->bytes_per_pixel);
}

void DeclaredTechnique::make_rays(Frame& frame) {
    const ResolvedRays& rays = frame.rays.emplace(inputs_->make(frame.graph, frame.gbuffer));
    frame.buffers[ray_buffers[0]] = rays.traced.directions;
    frame.buffers[ray_buffers[1]] = rays.traced.hits;
    frame.images[below_horizon_image] = rays.below_horizon;
}

Image DeclaredTechnique::image_of(Frame& frame, const DeclaredUse& use) {
    const auto own = frame.images.find(use.image);
    const Image image =
        own != frame.images.end() ? own->second : provided_.image(frame.graph, frame.gbuffer, use.image);
    return (use.mip ? image.mip(*use.mip) : image).as(use.as);
}

void DeclaredTechnique::run(Frame& frame, const DeclaredPass& declared) {
    if (!declared.cleared.empty()) {
        const PushValue& value = declared.set.at("value");
        if (const auto buffer = frame.buffers.find(declared.cleared); buffer != frame.buffers.end())
            return frame.graph.clear(buffer->second, std::holds_alternative<int>(value) ? std::get<int>(value) : 0);
        const auto* color = std::get_if<glm::vec4>(&value);
        return frame.graph.clear(frame.images.at(declared.cleared), color ? *color : glm::vec4(0));
    }
    std::vector<std::pair<Image, Sampling>> reads;  // made before the pass, for some are passes themselves
    for (const DeclaredUse* read : in_use(declared.reads, &DeclaredUse::as, frame.known))
        reads.emplace_back(
            image_of(frame, *read),
            Sampling{.is_linear = read->is_linear.holds(frame.known), .wrap_u = read->wrap_u, .wrap_v = read->wrap_v});
    PassGraph::Pass pass =
        declared.is_compute ? frame.graph.compute(declared.shader) : frame.graph.fragment(declared.shader);
    pass.label(declared.stage);
    for (const auto& [image, sampling] : reads) pass.read(image, sampling);
    for (const DeclaredUse* write : in_use(declared.writes, &DeclaredUse::as, frame.known))
        pass.write(image_of(frame, *write));
    if (const auto& test = declared.depth; test && test->when.holds(frame.known))
        pass.depth({.compare = test->compare, .is_written = test->is_written, .image = frame.images.at(test->image)});
    if (const auto& test = declared.stencil; test && test->when.holds(frame.known))
        pass.stencil({.mode = test->mode, .value = test->value, .image = frame.images.at(test->image)});
    for (const std::string& buffer : declared.buffers) pass.use(frame.buffers.at(buffer));
    for (const auto& [name, value] : declared.set)
        std::visit([&](const auto& number) { pass.set(name, number); }, value);
    if (declared.has_environment) bind_environment(pass, frame.gbuffer);
    run_with_tracers(frame, declared, pass);
}

void DeclaredTechnique::run_with_tracers(Frame& frame, const DeclaredPass& declared, const PassGraph::Pass& pass) {
    const auto run = [&](PassGraph::Pass& once) {
        const bool has_extent = declared.is_compute && (!declared.over.empty() || declared.writes.empty());
        if (!has_extent) return once.run();
        if (inputs_ && declared.over == traced_pixels) return once.run(inputs_->traced_extent(frame.graph.extent()));
        once.run(declared.over.empty() ? frame.graph.extent() : frame.images.at(declared.over).extent);
    };
    if (declared.tracers.empty()) {
        PassGraph::Pass once = pass;
        return run(once);
    }
    if (!frame.pyramids)
        frame.pyramids = tracers_.images(frame.graph, frame.gbuffer.depth, {}, slots_in_use(frame.known));
    tracers_.run(frame.graph, pass, declared.tracers, *frame.pyramids, ray_probe, rays_of(declared), run);
}

unsigned DeclaredTechnique::rays_of(const DeclaredPass& pass) const {
    if (pass.rays_parameter.empty()) return pass.rays;
    return std::ranges::find(params, pass.rays_parameter, &Parameter::name)->value.get<unsigned>();
}

TracingVariant::Needless DeclaredTechnique::find_needless(const SceneFacts& facts) {
    facts_ = facts;
    const KnownValues unknown_shot(params), known(params, facts);
    Needless needless;
    if (technique_->reflects) {
        const auto& [parameter, is_excluded] = *technique_->reflects;
        const float limit = known.by_name().at(parameter).get<float>();
        needless.such_a_surface = (is_excluded ? "smoother than " : "as smooth as ") + parameter;
        needless.rays =
            !facts.has_reflective || (is_excluded ? facts.min_roughness >= limit : facts.min_roughness > limit);
    }
    const auto add_stage = [&](const std::string& stage) {
        if (!stage.empty() && !std::ranges::count(needless.stages, stage)) needless.stages.push_back(stage);
    };
    const TracerNeeds needs = tracers_.needs(slots_in_use(unknown_shot));
    for (const DeclaredPass* pass : passes_in_use(unknown_shot)) {
        for (const DeclaredUse* read : in_use(pass->reads, &DeclaredUse::as, unknown_shot))
            add_stage(ProvidedImages::stage_of(read->image));
        if (!pass->tracers.empty() && (needs.nearest_mips > 0 || needs.farthest_mips > 0))
            add_stage("common/depth_pyramid");
        add_stage(pass->stage);
        if (!pass->when.holds(known)) {
            needless.parts.push_back({pass->stage, pass->when.failing_member(known),
                                      "the technique's declaration runs it for other shots only", "", false});
            continue;
        }
        const auto looks_at = [&](const char* constant) {
            const auto found = pass->scene_constants.find(constant);
            return found != pass->scene_constants.end() && found->second.holds(known);
        };
        if (looks_at("scene_has_matte")) needless.specular_readers.push_back(pass->stage);
        if (looks_at("scene_is_still")) needless.motion_readers.push_back(pass->stage);
        if (looks_at("scene_has_environment")) needless.environment_readers.push_back(pass->stage);
    }
    if (inputs_) inputs_->add_needless(needless, facts, *resolves_);
    return needless;
}

}  // namespace

std::unique_ptr<Variant> make_declared(std::shared_ptr<const Technique> technique) {
    return std::make_unique<DeclaredTechnique>(std::move(technique));
}
