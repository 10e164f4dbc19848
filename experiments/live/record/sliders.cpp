#include "experiments/live/record/sliders.h"

#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "core/gpu/pipelines/shader_error.h"
#include "experiments/study/measuring/rehearsal.h"
#include "experiments/study/measuring/render_technique.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;

/// All that two frames of an empty G-buffer do, as text, but for the values of parameters.
std::string commands_of(Device& device, const PointConfig& point, glm::uvec2 extent, KnownReads& reads) {
    const HostGBuffer empty = empty_gbuffer(extent);
    const Renderer renderer(device, extent, point);
    renderer.technique->limits = Limits::webgl2;
    RecordedTexels texels;
    Recorder recorder(*renderer.pass_list, texels, reads);
    PassList inputs(device, extent);
    json frames = json::array();
    for (unsigned index = 0; index < 2; ++index) {
        const GBuffer gbuffer = upload_gbuffer(inputs, empty);
        CameraData camera = empty.camera;
        camera.frame.x = index, camera.frame.w = index > 0;
        recorder.begin_frame(gbuffer);
        const Reflections reflections = renderer.render(camera, point.seeds.front(), gbuffer);
        frames.push_back(recorder.end_frame(reflections));
    }
    renderer.pass_list->times();  // waits, so that the images outlive the work
    if (recorder.programs().empty()) return {};
    return json{frames, recorder.images(), recorder.programs(), recorder.command_lists(), texels.texts()}.dump();
}

/// The ends of what a parameter may be, in place of its value.
std::vector<json> ends_of(const Parameter& p) {
    if (!p.choices.empty()) return {p.choices.front(), p.choices.back()};
    if (p.glsl_type == "bool") return {false, true};
    return {p.min, p.max};
}

}  // namespace

json slider_json(const Parameter& p) {
    return {{"name", p.name},       {"type", p.glsl_type}, {"unit", p.unit}, {"doc", p.doc},        {"value", p.value},
            {"initial", p.initial}, {"min", p.min},        {"max", p.max},   {"choices", p.choices}};
}

json recorded_parameters(Device& device, const PointConfig& point, glm::uvec2 extent, const std::set<unsigned>& read,
                         KnownReads& known_reads) {
    const std::unique_ptr<Technique> technique = make_technique(point.technique, point.parameters, point.preset);
    const std::string as_recorded = commands_of(device, point, extent, known_reads);
    json all = json::array(), compiled_in = json::array();
    unsigned place = 0;
    for (const Parameter& p : technique->params) {
        json one = slider_json(p);
        one["is_slider"] = false;
        one["is_uniform"] = p.use == Use::uniform;
        if (p.use == Use::constant) {
            one["why_not"] = "compiled into the shaders";
            if (is_read(technique->params, p.name)) compiled_in.push_back(std::move(one));
            continue;
        }
        const auto changes_more = [&](const json& value) {
            PointConfig changed = point;
            changed.parameters[p.name] = value;
            return commands_of(device, changed, extent, known_reads) != as_recorded;
        };
        if (!read.contains(place++))
            one["why_not"] = "no recorded shader reads it";
        else if (std::ranges::any_of(ends_of(p), changes_more))
            one["why_not"] = "it also decides passes, images or their constants";
        else
            one["is_slider"] = true;
        all.push_back(std::move(one));
    }
    all.insert(all.end(), compiled_in.begin(), compiled_in.end());
    return all;
}

void require_replayable(Device& device, const PointConfig& point) {
    make_technique(point.technique, point.parameters, point.preset);  // what is wrong with these is said as it is
    const std::string name = point.technique + (point.preset.empty() ? "" : " (" + point.preset + ")");
    std::string commands;
    try {
        KnownReads reads;
        commands = commands_of(device, point, {16, 16}, reads);
    } catch (const MachineError&) {
        throw;
    } catch (const ShaderError&) {
        throw;
    } catch (const Error& error) {
        fail(name, " cannot be replayed in a browser: ", error.what());
    }
    if (commands.empty()) fail(name, " has no passes: there is nothing to replay");
}
