#include "variants/tracers/tracers.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/common/depth_pyramid.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cstring>

TracerEntry dda_tracer();
TracerEntry hierarchy_tracer();
TracerEntry frostbite_hierarchical_tracer();
TracerEntry frostbite_linear_tracer();
TracerEntry hzb_tracer();
TracerEntry fixed_stride_tracer();
TracerEntry cells_tracer();
TracerEntry view_space_tracer();
TracerEntry secant_tracer();
TracerEntry godot_tracer();
TracerEntry exact_layer_tracer();
TracerEntry exact_scene_tracer();

std::span<const TracerEntry> tracer_table() {
    static const std::vector<TracerEntry> table = {
        dda_tracer(),
        hierarchy_tracer(),
        frostbite_hierarchical_tracer(),
        frostbite_linear_tracer(),
        hzb_tracer(),
        fixed_stride_tracer(),
        cells_tracer(),
        view_space_tracer(),
        secant_tracer(),
        godot_tracer(),
        exact_layer_tracer(),
        exact_scene_tracer(),
    };
    return table;
}

namespace {

std::vector<std::string> tracer_names() {
    std::vector<std::string> names;
    for (const TracerEntry& entry : tracer_table()) names.push_back(entry.name);
    return names;
}

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

TracerNeeds both(const TracerNeeds& a, const TracerNeeds& b) {
    return {.nearest_mips = std::max(a.nearest_mips, b.nearest_mips),
            .farthest_mips = std::max(a.farthest_mips, b.farthest_mips),
            .depth_layers = a.depth_layers || b.depth_layers,
            .random = a.random || b.random,
            .exact_hits = a.exact_hits || b.exact_hits};
}

/// Fails if a parameter has the name of a technique's, so that it would be taken for one of that.
std::unique_ptr<Tracer> created(const TracerEntry& entry, ParameterSet& params) {
    const std::string part = part_of(entry);
    const auto before = std::distance(params.begin(), params.end());
    std::unique_ptr<Tracer> tracer = entry.create(params);
    for (auto p = params.begin() + before; p != params.end(); ++p)
        if (p->part() != part)
            fail("the tracer ", entry.name, " declares a parameter '", p->name, "', whose name must begin with '", part,
                 ".'");
    return tracer;
}

std::vector<RayRecord> download_records(PassGraph& graph, const Buffer& buffer) {
    const std::vector<std::byte> bytes = graph.download(buffer);
    std::vector<RayRecord> rays(bytes.size() / sizeof(RayRecord));
    std::memcpy(rays.data(), bytes.data(), rays.size() * sizeof(RayRecord));
    return rays;
}

}  // namespace

const TracerEntry& find_tracer(const std::string& name) {
    for (const TracerEntry& entry : tracer_table())
        if (entry.name == name) return entry;
    fail("unknown tracer '", name, "'", suggestion(name, tracer_names()));
}

std::string part_of(const TracerEntry& tracer) { return tracer.part.empty() ? tracer.name : tracer.part; }

bool is_of_chosen_tracer(const ParameterSet& params, const std::string& name) {
    if (name == "exact_share") return params.values().at("exact_rays") != "none";
    const std::string part = std::ranges::find(params, name, &Parameter::name)->part();
    if (!std::ranges::count(tracer_table(), part, part_of)) return true;
    return std::ranges::any_of(params, [&](const Parameter& slot) {
        return slot.choices == tracer_names() && part_of(find_tracer(slot.value.get<std::string>())) == part;
    });
}

Tracers::Tracers(ParameterSet& params, std::vector<TracerSlot> slots, const std::string& source,
                 const nlohmann::json& defaults)
    : params_(params), slots_(std::move(slots)) {
    if (slots_.empty()) return;
    for (const TracerSlot& slot : slots_)
        Choice(params, slot.name, slot.initial, tracer_names(), {"", slot.doc, source});
    for (const TracerEntry& entry : tracer_table()) tracers_.push_back(created(entry, params));
    asked_rays_ = std::make_unique<AskedRaysParameters>(params);
    params.change_defaults(defaults);
}

const TracerEntry& Tracers::chosen(const std::string& slot) const {
    const auto parameter = std::ranges::find(params_, slot, &Parameter::name);
    return find_tracer(parameter->value.get<std::string>());
}

TracerNeeds Tracers::needs(const std::string& slot) const {
    TracerNeeds needs = tracer_of(slot).needs();
    needs.exact_hits = needs.exact_hits || asked_rays_->are_any();
    needs.random = needs.random || asked_rays_->are_any();  // among equal rays, too
    return needs;
}

bool Tracers::asks_for_some(const std::vector<std::string>& slots) const {
    if (!asked_rays_ || !asked_rays_->are_any()) return false;
    for (const std::string& slot : slots) {
        if (tracer_of(slot).needs().exact_hits)
            fail("exact_rays lets the scene answer some rays, ", slot, " = ", chosen(slot).name,
                 " all of them: one of both is enough");
        // Rays that are answered leave the march, whose others would then be given up sooner.
        if (const std::string why = tracer_of(slot).not_repeatable(); !why.empty())
            fail("exact_rays needs a march whose rays do not depend on each other; ", why);
    }
    return true;
}

const Tracer& Tracers::tracer_of(const std::string& slot) const {
    return *tracers_[size_t(&chosen(slot) - tracer_table().data())];
}

TracerNeeds Tracers::needs() const {
    TracerNeeds all;
    for (const TracerSlot& slot : slots_) all = both(all, needs(slot.name));
    return all;
}

bool Tracers::needs_pyramid() const {
    const TracerNeeds all = needs();
    return all.nearest_mips > 0 || all.farthest_mips > 0;
}

std::string Tracers::not_repeatable() const {
    for (const TracerSlot& slot : slots_)
        if (std::string why = tracer_of(slot.name).not_repeatable(); !why.empty()) return why;
    return {};
}

TracerNeeds Tracers::needs(const std::vector<std::string>& slots) const {
    TracerNeeds all;
    for (const std::string& slot : slots) all = both(all, needs(slot));
    return all;
}

Tracers::Images Tracers::images(PassGraph& graph, const Image& depth, const PyramidMaker& make,
                                const std::vector<std::string>& slots) const {
    const PyramidMaker maker = make ? make : PyramidMaker(depth_pyramid);
    const TracerNeeds all = slots.empty() ? needs() : needs(slots);
    Images images;
    if (all.nearest_mips > 0) images.nearest = maker(graph, depth, all.nearest_mips, false);
    if (all.farthest_mips > 0) images.farthest = maker(graph, depth, all.farthest_mips, true);
    return images;
}

void Tracers::run(PassGraph& graph, const PassGraph::Pass& pass, const std::vector<std::string>& slots,
                  const Images& images, RayProbe* probe, unsigned rays_per_pixel,
                  const std::function<void(PassGraph::Pass&)>& run) const {
    const TracerNeeds needed = needs(slots);
    const bool has_asked = asks_for_some(slots);
    if (needed.exact_hits && (!probe || !(has_asked ? bool(probe->answers) : bool(probe->exact_hits))))
        fail(
            "the tracer exact_scene, and exact_rays, use scene data, which only ssrlab's commands provide, and not for "
            "captures");
    if (needed.depth_layers && !graph.has_input("second_depth"))
        fail(
            "the chosen tracer reads the layer behind the visible surfaces: captures lack it, and scenes' frames have "
            "it only if the technique's needs_depth_layers() returns true");
    const size_t rays = size_t(graph.extent().x) * graph.extent().y * rays_per_pixel;
    const auto buffer = [&] { return graph.buffer("ray_records", rays * sizeof(RayRecord)); };
    const RecordedRays* replayed = nullptr;
    if (probe)
        for (const RecordedRays& recorded : probe->replayed)
            if (recorded.stage == pass.stage() && recorded.rays.size() == rays) replayed = &recorded;
    const ShaderTracing include{needed, rays_per_pixel, replayed != nullptr, has_asked};
    const Buffer answers = needed.exact_hits ? graph.buffer("exact_hits", rays * sizeof(ExactHit)) : Buffer();
    const auto recorded = [&]() -> RecordedRays {
        return {pass.stage(), rays_per_pixel, download_records(graph, buffer())};
    };
    const auto run_as = [&](Including what) {
        PassGraph::Pass tracing = pass;
        for (const TracerSlot& slot : slots_)
            if (std::ranges::count(slots, slot.name))
                tracing.include(slot.name, glsl_of(slot, chosen(slot.name), include, what));
        const bool traces = what != Including::rays_only;
        if (traces && needed.nearest_mips > 0) tracing.read(images.nearest);
        if (traces && needed.farthest_mips > 0) tracing.read(images.farthest);
        if (traces && needed.exact_hits) tracing.use(answers);
        if (traces && replayed) {
            const Buffer replaying = graph.buffer("replayed_rays", rays * sizeof(RayRecord));
            graph.upload(replaying, std::as_bytes(std::span(replayed->rays)));
            tracing.use(replaying);
        }
        if (what != Including::trace) {
            graph.clear(buffer(), 0);
            tracing.use(buffer());
        }
        run(tracing);
    };
    if (has_asked) {
        const std::vector<ExactHit> none(rays, ExactHit{.outcome = outcome_unanswered});
        graph.upload(answers, std::as_bytes(std::span(none)));
        run_as(Including::record);
        const std::vector<ExactHit> found = probe->answers(recorded(), asked_rays_->value());
        graph.upload(answers, std::as_bytes(std::span(found)));
    } else if (needed.exact_hits) {
        run_as(Including::rays_only);
        const std::vector<ExactHit> hits = probe->exact_hits(recorded());
        graph.upload(answers, std::as_bytes(std::span(hits)));
    }
    if (probe && probe->is_recording) {
        run_as(Including::record);
        probe->recorded.push_back(recorded());
    }
    run_as(Including::trace);
}

ShaderIncludes Tracers::includes() const {
    std::vector<std::string> names;
    for (const TracerSlot& slot : slots_) names.push_back(slot.name);
    const ShaderTracing all{.needs = needs(), .has_asked = asks_for_some(names)};
    ShaderIncludes includes;
    for (const TracerSlot& slot : slots_) includes[slot.name] = glsl_of(slot, chosen(slot.name), all, Including::trace);
    return includes;
}
