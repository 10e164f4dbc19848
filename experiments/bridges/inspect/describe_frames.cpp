// What is understood of folders of frames: a capture of G-buffers, and what an engine rendered.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/parameters.h"
#include "core/scene/load_scene.h"
#include "experiments/bridges/inspect/channel_range.h"
#include "experiments/bridges/inspect/describe.h"
#include "experiments/bridges/judge.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/measuring/frames/capture.h"

#include <cmath>

namespace fs = std::filesystem;

namespace {

/// Of a projection of Vulkan's clip space; y points down there.
Description capture_camera(const CameraData& camera) {
    const bool is_orthographic = camera.frame.z == 1;
    const float scale = std::abs(camera.clip_from_view[1][1]);
    Description entry = {{"projection", is_orthographic ? "orthographic" : "perspective"}};
    if (is_orthographic)
        entry["height"] = json_number(2.0f / scale);
    else
        entry["vertical_fov"] = json_number(glm::degrees(2.0f * std::atan(1.0f / scale)));
    entry["near"] = json_number(camera.depth.x), entry["far"] = json_number(camera.depth.y);
    entry["depth"] = camera.depth.w == 1 ? "reversed" : "standard";
    const glm::vec3 position = camera.world_from_view[3];
    entry["position"] = {json_number(position.x), json_number(position.y), json_number(position.z)};
    return entry;
}

}  // namespace

Description describe_capture(const fs::path& folder) {
    Capture capture(folder);
    const ShotConfig config{.frames = capture.frames(), .gbuffer = folder};
    const Shot shot = capture_shot(config, capture);
    const CaptureContents contents = inspect_capture(shot, capture);
    const unsigned first = config.frames.front();
    Description image = describe_exr(capture.folder_of(first) / "gbuffer.exr");
    Description facts = Description::object();
    for (const SceneFact& fact : list_facts(pixel_facts(capture.played(first, {}))))
        facts[fact.name] = {{"value", fact.value}, {"why", fact.why}};
    return {{"kind", "capture"},
            {"folder", folder.string()},
            {"name", shot.scene.name},
            {"width", shot.config.extent.x},
            {"height", shot.config.extent.y},
            {"frames", config.frames},
            {"camera", capture_camera(capture.load(first).gbuffer.camera)},
            {"has_lit", contents.has_lit},
            {"has_environment", capture.environment().has_value()},
            {"channels", image["channels"]},
            {"pixels", facts},
            {"notes", contents.notes}};
}

Description describe_external_frames(const fs::path& folder, const std::string& scene,
                                     const std::vector<fs::path>& search_path) {
    const auto images = read_external_images(folder, folder.string());
    Description views = Description::array();
    const std::string name = scene.empty() ? "" : load_scene(scene, search_path).name;
    for (const FramesOfView& view : views_of_frames(folder, name, search_path)) {
        Description& entry = views.emplace_back(Description{{"scene", view.name.scene},
                                                            {"camera", view.name.camera},
                                                            {"width", view.width},
                                                            {"height", view.height},
                                                            {"frames", view.frames}});
        const fs::path first = view.folder / ("f" + std::to_string(*view.frames.begin()) + ".s0.exr");
        entry["channels"] = describe_exr(first)["channels"];
    }
    return {{"kind", "frames"},
            {"folder", folder.string()},
            {"name", images->name},
            {"point", images->point},
            {"engine", images->engine},
            {"version", images->version},
            {"settings", images->settings},
            {"seeds", images->seeds},
            {"views", views}};
}
