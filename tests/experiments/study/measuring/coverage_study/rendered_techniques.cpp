#include "tests/experiments/study/measuring/coverage_study/rendered_techniques.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/measuring/reflection_probe.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/shots/result_images.h"

namespace {

/// The one that all studies of the scene read: another reference brings no other.
std::optional<Environment> probe_of(const Shot& shot) {
    if (!shot.config.has_probe) return {};
    const ShotFrame now = shot_frame(shot, 0);
    return reflection_probe(now.camera.world_from_view[3], {},
                            [&](const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& of_face) {
                                return render_reference(shot.scene, now.scene, camera, extent, of_face);
                            });
}

}  // namespace

Techniques rendered_techniques(const std::string& scene, glm::uvec2 extent, bool has_probe, const Reference& truth,
                               unsigned seeds) {
    ShotConfig config{.scene = scene, .extent = extent};
    config.has_probe = has_probe;
    const Shot shot = load_shot(config, {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"});
    const std::optional<Environment> probe = probe_of(shot);
    Device device;
    const auto source = scene_source(device, shot, {}, false, probe ? &*probe : nullptr);
    FrameStore store(*source, shot.config, size_t(1) << 28);
    const FrameStore::Frame frame = store.frame(shot.steps.back(), truth.diffuse.mean);
    const HostImage reflectance = specular_reflectance(
        download_gbuffer(source->pass_list(), frame.gbuffer, frame.camera, shot.config.depth_format));
    Techniques techniques{.baselines = {{"none", {"linear tracing", "frostbite"}}, {"linear tracing", {"frostbite"}}}};
    const auto render = [&](const std::string& name, const char* technique, const char* preset, unsigned count) {
        PointConfig point;
        point.technique = technique, point.preset = preset;
        for (unsigned seed = 1; seed <= count; ++seed) {
            const Renderer renderer(device, extent, point);  // without a history
            const Reflections reflections = renderer.render(frame.camera, seed, frame.gbuffer);
            const Composite composite = renderer.compositor->render(frame.gbuffer, reflections);
            techniques.images[name].push_back(
                download_results(*renderer.pass_list, frame.gbuffer, reflections, composite, reflectance));
        }
    };
    render("none", "none", "", 1), render("linear tracing", "mcguire_dda", "best", 1);
    render("frostbite", "frostbite_sssr", "best", seeds);
    return techniques;
}
