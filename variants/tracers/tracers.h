#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_list.h"
#include "core/gpu/pipelines/shader.h"
#include "core/ray_probe.h"
#include "variants/tracers/tracer.h"

#include <functional>
#include <span>

/// All tracers, by name.
std::span<const TracerEntry> tracer_table();

/// Fails with a near miss if there is none of that name.
const TracerEntry& find_tracer(const std::string& name);

/// Of the parameter of that name, which there is.
const nlohmann::json& value_of(const ParameterSet& params, const std::string& name);

/// Whether a technique whose parameters have these values has chosen the tracer whose parameter `name` is; true of
/// parameters that are no tracer's.
bool is_of_chosen_tracer(const ParameterSet& params, const std::string& name);

/// How a technique makes pyramids of depth (common/depth_pyramid.h): of at most so many levels, of the nearest or of
/// the farthest depths.
using PyramidMaker = std::function<Image(PassList&, const Image& depth, unsigned mips, bool keeps_farthest)>;

/// The place of a tracer in a technique: the parameter `name`, which chooses one. Shaders write `#include "<name>"` and
/// call `function`.
struct TracerSlot {
    std::string name, function, initial, doc;
};

/// The tracers that a technique can use, their parameters, and the choice among them.
class Tracers {
public:
    /// Declares a choice for each slot, then the parameters of all tracers; nothing if there is no slot. `defaults`:
    /// where they are the technique's own, as of ParameterSet::change_defaults(). `source`: of the slots' initial
    /// tracers.
    Tracers(ParameterSet& params, std::vector<TracerSlot> slots, const std::string& source,
            const nlohmann::json& defaults = nlohmann::json::object());

    /// The entry that a slot's parameter has chosen.
    const TracerEntry& chosen(const std::string& slot) const;
    TracerNeeds needs(const std::string& slot) const;
    TracerNeeds needs() const;  ///< of all slots
    TracerNeeds needs(const std::vector<std::string>& slots) const;
    std::string not_repeatable() const;  ///< of the first that says so

    /// What slots need, made for this frame.
    struct Images {
        Image nearest, farthest;  ///< pyramids; without storage where no tracer needs them
    };
    /// Of all slots, if none is named.
    Images images(PassList& pass_list, const Image& depth, const PyramidMaker& make = {},
                  const std::vector<std::string>& slots = {}) const;

    /// Runs `pass`, whose shader includes `slots`, by `run` (over all pixels); before that once or twice more, with a
    /// probe that needs it, to get at its rays. Each pixel traces at most `rays_per_pixel` rays, of different
    /// TraceRay::number. Fails if exact hits are needed and `probe` has none.
    void run(
        PassList& pass_list, const PassList::Pass& pass, const std::vector<std::string>& slots, const Images& images,
        RayProbe* probe, unsigned rays_per_pixel = 1,
        const std::function<void(PassList::Pass&)>& run = [](PassList::Pass& pass) { pass.run(); }) const;

    /// What the slots' names stand for in shaders, for whoever compiles them outside of run().
    ShaderIncludes includes() const;

private:
    std::string not_repeatable(const std::string& slot) const;

    /// Whether the scene answers some rays in place of their march, as by ray tracing hardware: the parameter
    /// exact_rays. RayProbe::answers of core/ray_probe.h chooses them and knows the answers.
    bool asks_for_some() const;
    /// The same of these slots' rays. Fails where one of their tracers does not allow it.
    bool asks_for_some(const std::vector<std::string>& slots) const;

    ParameterSet& params_;
    std::vector<TracerSlot> slots_;
};
