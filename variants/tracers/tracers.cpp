#include "variants/tracers/tracers.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/common/depth_pyramid.h"
#include "variants/common/names.h"
#include "variants/common/parameter_block.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cstring>

const nlohmann::json& value_of(const ParameterSet& params, const std::string& name) {
    return std::ranges::find(params, name, &Parameter::name)->value;
}

std::span<const TracerEntry> tracer_table() {
    static const std::vector<TracerEntry> table = [] {
        std::vector<TracerEntry> read;
        for (const char* file : {"dda/dda.json", "hierarchy/hierarchy.json", "frostbite/frostbite_hierarchical.json",
                                 "frostbite/frostbite_linear.json", "hzb/hzb.json", "fixed_stride/fixed_stride.json",
                                 "cells/cells.json", "view_space/view_space.json", "secant/secant.json",
                                 "godot/godot.json", "exact_layer/exact_layer.json", "exact_scene/exact_scene.json"})
            read.push_back(read_tracer(file));
        return read;
    }();
    return table;
}

namespace {

std::vector<std::string> tracer_names() { return names_of(tracer_table(), &TracerEntry::name); }

/// What an include does besides tracing.
enum class Including { trace, record, rays_only };

/// What the includes of all slots of a shader have in common.
struct ShaderTracing {
    TracerNeeds needs;  ///< of all slots
    unsigned rays_per_pixel = 1;
    bool replays = false;    ///< RayProbe::replayed
    bool has_asked = false;  ///< RayProbe::answers
};

/// The GLSL that stands for the slot.
std::string glsl_of(const TracerSlot& slot, const TracerEntry& tracer, const ShaderTracing& all, Including what) {
    const auto& [needs, rays_per_pixel, replays, has_asked] = all;
    const std::string head = "TraceEnd " + slot.function + "(TraceRay ray) ", march = tracer.name + "_trace(ray)";
    const std::string call = has_asked ? slot.function + "_or_answer(ray)" : march;
    const std::string file =
        "#include \"" + tracer.shader + "\"\n" +
        (has_asked ? "#include \"tracers/exact_scene/exact_scene.glsl\"\nTraceEnd " + slot.function +
                         "_or_answer(TraceRay ray) {\n    if (exact_scene_answers(ray)) return "
                         "exact_scene_trace(ray);\n    return " +
                         march + ";\n}\n"
                   : "");
    const std::string constants =
        "#ifndef RECORDED_RAYS_PER_PIXEL\n#define RECORDED_RAYS_PER_PIXEL\nconst uint "
        "recorded_rays_per_pixel = " +
        std::to_string(rays_per_pixel) + "u;\n#endif\n";
    const std::string recorder = constants + (replays ? "#ifndef REPLAYED_RAYS\n#define REPLAYED_RAYS\n#endif\n" : "") +
                                 "#include \"tracers/record.glsl\"\n";
    const std::string replay =
        replays ? "    if (!replay(ray)) return missed(outcome_unfinished, vec2(0.0), 0.0);\n" : std::string();
    if (what == Including::rays_only)
        return recorder + head +
               "{\n    TraceEnd end = missed(outcome_unfinished, vec2(0.0), 0.0);\n    record(ray, end);\n    return "
               "end;\n}\n";
    std::string text = needs.depth_layers ? "#define TRACER_HAS_DEPTH_LAYERS\n" : "";
    if (needs.exact_hits || replays) text += recorder;
    if (what == Including::trace) return text + file + head + "{\n" + replay + "    return " + call + ";\n}\n";
    return "#ifndef COUNT_DEPTH_FETCHES\n#define COUNT_DEPTH_FETCHES\n#endif\n" + text + file + recorder + head +
           "{\n" + replay + "    depth_fetches = 0u;\n    TraceEnd end = " + call +
           ";\n    record(ray, end);\n    return end;\n}\n";
}

std::vector<RayRecord> download_records(PassList& pass_list, const Buffer& buffer) {
    const std::vector<std::byte> bytes = pass_list.download(buffer);
    std::vector<RayRecord> rays(bytes.size() / sizeof(RayRecord));
    std::memcpy(rays.data(), bytes.data(), rays.size() * sizeof(RayRecord));
    return rays;
}

}  // namespace

const TracerEntry& find_tracer(const std::string& name) { return find_named(tracer_table(), name, "unknown tracer"); }

bool is_of_chosen_tracer(const ParameterSet& params, const std::string& name) {
    if (name == "exact_share") return params.values().at("exact_rays") != "none";
    const std::string part = std::ranges::find(params, name, &Parameter::name)->part();
    if (!std::ranges::count(tracer_table(), part, &TracerEntry::part)) return true;
    return std::ranges::any_of(params, [&](const Parameter& slot) {
        return slot.choices == tracer_names() && find_tracer(slot.value.get<std::string>()).part == part;
    });
}

Tracers::Tracers(ParameterSet& params, std::vector<TracerSlot> slots, const std::string& source,
                 const nlohmann::json& defaults)
    : params_(params), slots_(std::move(slots)) {
    if (slots_.empty()) return;
    for (const TracerSlot& slot : slots_)
        params.add(choice_of(slot.name, slot.initial, tracer_names(), slot.doc, source));
    for (const TracerEntry& entry : tracer_table())
        for (const Parameter& parameter : entry.parameters) params.add(parameter);
    add_block(params, "tracers/asked_rays.json");
    params.change_defaults(defaults);
}

const TracerEntry& Tracers::chosen(const std::string& slot) const {
    return find_tracer(value_of(params_, slot).get<std::string>());
}

bool Tracers::asks_for_some() const { return !slots_.empty() && value_of(params_, "exact_rays") != "none"; }

TracerNeeds Tracers::needs(const std::string& slot) const {
    const TracerEntry& tracer = chosen(slot);
    const KnownValues known(params_);
    const auto mips = [&](const std::string& name) {
        return name.empty() ? 0u : known.by_name()[name].get<unsigned>();
    };
    return {.nearest_mips = mips(tracer.nearest_mips),
            .farthest_mips = mips(tracer.farthest_mips),
            .depth_layers = tracer.depth_layers.holds(known),
            .random = tracer.random.holds(known) || asks_for_some(),  // among equal rays, too
            .exact_hits = tracer.exact_hits || asks_for_some()};
}

bool Tracers::asks_for_some(const std::vector<std::string>& slots) const {
    if (!asks_for_some()) return false;
    for (const std::string& slot : slots) {
        if (chosen(slot).exact_hits)
            fail("exact_rays lets the scene answer some rays, ", slot, " = ", chosen(slot).name,
                 " all of them: one of both is enough");
        // Rays that are answered leave the march, whose others would then be given up sooner.
        if (const std::string why = not_repeatable(slot); !why.empty())
            fail("exact_rays needs a march whose rays do not depend on each other; ", why);
    }
    return true;
}

std::string Tracers::not_repeatable(const std::string& slot) const {
    return because(chosen(slot).not_repeatable, KnownValues(params_));
}

TracerNeeds Tracers::needs() const { return needs(names_of(slots_, &TracerSlot::name)); }

std::string Tracers::not_repeatable() const {
    for (const TracerSlot& slot : slots_)
        if (std::string why = not_repeatable(slot.name); !why.empty()) return why;
    return {};
}

TracerNeeds Tracers::needs(const std::vector<std::string>& slots) const {
    TracerNeeds all;
    for (const std::string& slot : slots) {
        const TracerNeeds one = needs(slot);
        all.nearest_mips = std::max(all.nearest_mips, one.nearest_mips);
        all.farthest_mips = std::max(all.farthest_mips, one.farthest_mips);
        all.depth_layers |= one.depth_layers, all.random |= one.random, all.exact_hits |= one.exact_hits;
    }
    return all;
}

Tracers::Images Tracers::images(PassList& pass_list, const Image& depth, const PyramidMaker& make,
                                const std::vector<std::string>& slots) const {
    const PyramidMaker maker = make ? make : PyramidMaker(depth_pyramid);
    const TracerNeeds all = slots.empty() ? needs() : needs(slots);
    Images images;
    if (all.nearest_mips > 0) images.nearest = maker(pass_list, depth, all.nearest_mips, false);
    if (all.farthest_mips > 0) images.farthest = maker(pass_list, depth, all.farthest_mips, true);
    return images;
}

void Tracers::run(PassList& pass_list, const PassList::Pass& pass, const std::vector<std::string>& slots,
                  const Images& images, RayProbe* probe, unsigned rays_per_pixel,
                  const std::function<void(PassList::Pass&)>& run) const {
    const TracerNeeds needed = needs(slots);
    const bool has_asked = asks_for_some(slots);
    if (needed.exact_hits && (!probe || !(has_asked ? bool(probe->answers) : bool(probe->exact_hits))))
        fail(
            "the tracer exact_scene, and exact_rays, use scene data, which only ssrlab's commands provide, and not for "
            "captures");
    if (needed.depth_layers && !pass_list.has_input("second_depth"))
        fail(
            "the chosen tracer reads the layer behind the visible surfaces: captures lack it, and scenes' frames have "
            "it only if the technique's needs_depth_layers() returns true");
    const size_t rays = size_t(pass_list.extent().x) * pass_list.extent().y * rays_per_pixel;
    const auto buffer = [&] { return pass_list.buffer("ray_records", rays * sizeof(RayRecord)); };
    const RecordedRays* replayed = nullptr;
    if (probe)
        for (const RecordedRays& recorded : probe->replayed)
            if (recorded.stage == pass.stage() && recorded.rays.size() == rays) replayed = &recorded;
    const ShaderTracing include{needed, rays_per_pixel, replayed != nullptr, has_asked};
    const Buffer answers = needed.exact_hits ? pass_list.buffer("exact_hits", rays * sizeof(ExactHit)) : Buffer();
    const auto recorded = [&]() -> RecordedRays {
        return {pass.stage(), rays_per_pixel, download_records(pass_list, buffer())};
    };
    const auto run_as = [&](Including what) {
        PassList::Pass tracing = pass;
        for (const TracerSlot& slot : slots_)
            if (std::ranges::count(slots, slot.name))
                tracing.include(slot.name, glsl_of(slot, chosen(slot.name), include, what));
        const bool traces = what != Including::rays_only;
        if (traces && needed.nearest_mips > 0) tracing.read(images.nearest);
        if (traces && needed.farthest_mips > 0) tracing.read(images.farthest);
        if (traces && needed.exact_hits) tracing.use(answers);
        if (traces && replayed) {
            const Buffer replaying = pass_list.buffer("replayed_rays", rays * sizeof(RayRecord));
            pass_list.upload(replaying, std::as_bytes(std::span(replayed->rays)));
            tracing.use(replaying);
        }
        if (what != Including::trace) {
            pass_list.clear(buffer(), 0);
            tracing.use(buffer());
        }
        run(tracing);
    };
    if (has_asked) {
        const std::vector<ExactHit> none(rays, ExactHit{.outcome = outcome_unanswered});
        pass_list.upload(answers, std::as_bytes(std::span(none)));
        run_as(Including::record);
        const std::vector<ExactHit> found = probe->answers(
            recorded(), {value_of(params_, "exact_rays"), value_of(params_, "exact_share").get<float>()});
        pass_list.upload(answers, std::as_bytes(std::span(found)));
    } else if (needed.exact_hits) {
        run_as(Including::rays_only);
        const std::vector<ExactHit> hits = probe->exact_hits(recorded());
        pass_list.upload(answers, std::as_bytes(std::span(hits)));
    }
    if (probe && probe->is_recording) {
        run_as(Including::record);
        probe->recorded.push_back(recorded());
    }
    run_as(Including::trace);
}

ShaderIncludes Tracers::includes() const {
    const ShaderTracing all{.needs = needs(), .has_asked = asks_for_some(names_of(slots_, &TracerSlot::name))};
    ShaderIncludes includes;
    for (const TracerSlot& slot : slots_) includes[slot.name] = glsl_of(slot, chosen(slot.name), all, Including::trace);
    return includes;
}
