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

/// The value of the parameter `name`, which must exist.
const nlohmann::json& value_of(const ParameterSet& params, const std::string& name);

/// Whether a technique with these values has chosen the tracer that the parameter `name` belongs to. True for
/// parameters of no tracer.
bool is_of_chosen_tracer(const ParameterSet& params, const std::string& name);

/// Makes a depth pyramid (common/depth_pyramid.h) of at most `mips` levels, of the nearest or of the farthest depths.
using PyramidMaker = std::function<Image(PassList&, const Image& depth, unsigned mips, bool keeps_farthest)>;

/// The place of a tracer in a technique: the parameter `name` chooses the tracer. Shaders write `#include "<name>"` and
/// call `function`.
struct TracerSlot {
    std::string name, function, initial, doc;
};

/// The tracers that a technique can use, their parameters, and the choice among them.
class Tracers {
public:
    /// Declares a choice for each slot, then the parameters of all tracers; nothing without slots. `defaults`: the
    /// technique's own, as for ParameterSet::change_defaults(). `source`: of the slots' initial tracers.
    Tracers(ParameterSet& params, std::vector<TracerSlot> slots, const std::string& source,
            const nlohmann::json& defaults = nlohmann::json::object());

    /// The entry that a slot's parameter has chosen.
    const TracerEntry& chosen(const std::string& slot) const;
    TracerNeeds needs(const std::string& slot) const;
    TracerNeeds needs() const;  ///< of all slots
    TracerNeeds needs(const std::vector<std::string>& slots) const;
    std::string not_repeatable() const;  ///< of the first tracer with a reason

    /// The images that slots need in this frame.
    struct Images {
        Image nearest, farthest;  ///< pyramids; without storage where no tracer needs them
    };
    /// Makes the images; for all slots if none is named.
    Images images(PassList& pass_list, const Image& depth, const PyramidMaker& make = {},
                  const std::vector<std::string>& slots = {}) const;

    /// Runs `pass`, whose shader includes `slots`, by `run` (over all pixels). If `probe` needs the rays, runs it once
    /// or twice more before. Each pixel traces at most `rays_per_pixel` rays, of different TraceRay::number. Fails if
    /// exact hits are needed and `probe` has none.
    void run(
        PassList& pass_list, const PassList::Pass& pass, const std::vector<std::string>& slots, const Images& images,
        RayProbe* probe, unsigned rays_per_pixel = 1,
        const std::function<void(PassList::Pass&)>& run = [](PassList::Pass& pass) { pass.run(); }) const;

    /// The includes for the slots' names, for compiling shaders outside of run().
    ShaderIncludes includes() const;

private:
    std::string not_repeatable(const std::string& slot) const;

    /// Whether the scene answers some rays instead of their march, like ray tracing hardware: the parameter exact_rays.
    /// RayProbe::answers of core/ray_probe.h chooses these rays and answers them.
    bool asks_for_some() const;
    /// The same for these slots' rays. Fails if one of their tracers does not allow it.
    bool asks_for_some(const std::vector<std::string>& slots) const;

    ParameterSet& params_;
    std::vector<TracerSlot> slots_;
};
