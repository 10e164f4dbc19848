#include "variants/resolves/ray_inputs.h"

#include "variants/common/lit_history.h"
#include "variants/frostbite_sssr/horizon_image.h"

#include <algorithm>

struct RayInputs::Parts {
    ParameterSet& params;

    RayDrawParameters draw{params};
    // clang-format off
    Switch draw_directions{params, "draw_directions", true,
        {"", "draws each ray's direction from the lobe; otherwise it is the mirror's", "ssrlab, to measure the stage"}};
    Choice misses{params, "misses", "probe", {"weight", "fallback", "probe"},
        {"", "what a ray without a hit contributes. weight: only less confidence; fallback: the environment in its "
         "direction; probe: what the screen says of the surroundings there (variants/common/screen_probe), for scenes "
         "without reflection probes", "ssrlab"}};
    Switch previous_frame{params, "previous_frame", false,
        {"", "hits take their colour from the previous frame's lit image, where they were then; otherwise from this frame's",
         "ssrlab"}};
    // clang-format on
    LitHistory lit{};
    FrostbiteHorizonImage horizon{};
};

RayInputs::RayInputs(ParameterSet& params) : parts_(new Parts{params}) {}

RayInputs::~RayInputs() = default;

glm::uvec2 RayInputs::traced_extent(glm::uvec2 screen) const {
    return parts_->draw.half_resolution ? (screen + 1u) / 2u : screen;
}

unsigned RayInputs::max_rays() const { return parts_->draw.max_rays; }

ResolvedRays RayInputs::make(PassGraph& graph, const GBuffer& gbuffer) {
    Parts& of = *parts_;
    const glm::uvec2 extent = traced_extent(graph.extent());
    const size_t bytes = size_t(extent.x) * extent.y * max_rays() * 16;
    return {.traced = {.directions = graph.buffer("directions", bytes), .hits = graph.buffer("hits", bytes)},
            .color = of.previous_frame ? of.lit.previous(graph, gbuffer.lit) : gbuffer.lit,
            .below_horizon = of.horizon.on(graph, of.draw),
            .draw = of.draw,
            .probe = of.misses.is("probe") ? std::optional(screen_probe(graph, gbuffer)) : std::nullopt,
            .misses_are_known = !of.misses.is("weight"),
            .previous_frame = of.previous_frame};
}

Reflections RayInputs::show(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays,
                            Resolves& resolves) const {
    return resolves.run(graph, gbuffer, rays, parts_->draw_directions);
}

bool RayInputs::depends_on_seed(Resolves& resolves) const {
    const bool has_turns = parts_->draw.half_resolution;  // of pixels, in an order of the seed's
    return parts_->draw_directions || has_turns || resolves.chosen().draws_random_numbers();
}

std::string RayInputs::not_repeatable(const Tracers& tracers, Resolves& resolves) const {
    const std::string of_rays = tracers.not_repeatable(), of_resolve = resolves.chosen().not_repeatable();
    return of_rays + (of_rays.empty() || of_resolve.empty() ? "" : "; ") + of_resolve;
}

void RayInputs::add_needless(TracingVariant::Needless& needless, const SceneFacts& facts, Resolves& resolves) const {
    const Parts& of = *parts_;
    Resolve& resolve = resolves.chosen();
    const bool has_probe = of.misses.is("probe"), answers_rough = has_probe && resolve.answers_rough_surfaces();
    needless.such_a_surface = "as smooth as max_roughness";
    needless.rays = !facts.has_reflective || (facts.min_roughness > of.draw.max_roughness && !answers_rough);
    const auto add = [](std::vector<std::string>& list, const std::vector<std::string>& more) {
        list.insert(list.end(), more.begin(), more.end());
    };
    if (of.previous_frame) needless.stages.insert(needless.stages.begin(), "common/keep_lit");
    if (has_probe) add(needless.stages, screen_probe_stages());
    add(needless.stages, resolve.stages());
    const StageReads reads = resolve.reads();
    add(needless.specular_readers, reads.specular);
    add(needless.motion_readers, reads.motion);
    if (of.previous_frame && !std::ranges::count(reads.motion, reads.rays))
        needless.motion_readers.push_back(reads.rays);
    if (!of.misses.is("weight")) needless.environment_readers.push_back(reads.rays);
    if (has_probe) needless.environment_readers.push_back(screen_probe_stages().front());
}
