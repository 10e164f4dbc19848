#include "experiments/study/config/shots/plane_warnings.h"

#include "core/near_miss.h"
#include "core/scene/depth_precision.h"
#include "core/scene/view_depths.h"
#include "groundtruth/paths/plane_cuts.h"

namespace {

const char* const how_to_push_out =
    "A camera's \"planes\": \"scene\" in scene.json, or --planes scene, derives planes that cut nothing";

std::string cut_warning(const Shot& shot, const ShotFrame& frame) {
    const glm::uvec2 extent = shot.config.extent;
    const PlaneCuts cuts = count_plane_cuts(shot.scene, frame.scene, frame.camera, extent);
    if (cuts.count() == 0) return "";
    return "The planes of camera '" + shortened(shot.camera.name) + "' (" +
           shown_planes(frame.camera.near, frame.camera.far) + ") cut surfaces in " + std::to_string(cuts.count()) +
           " of " + std::to_string(size_t(extent.x) * extent.y) + " pixels of frame " + std::to_string(frame.frame) +
           ": " + std::to_string(cuts.before_near) + " before near, " + std::to_string(cuts.beyond_far) +
           " beyond far. Neither renderer shows them to the camera. " + how_to_push_out + ".";
}

}  // namespace

std::vector<SceneWarning> plane_warnings(const Shot& shot) {
    const ShotFrame frame = shot_frame(shot, shot.config.frames.front());
    const CameraData camera = camera_data(
        frame.camera, nullptr, {.extent = shot.config.extent, .depth_direction = shot.config.depth_direction});
    const auto precision = [&](const DepthRange& depths) {
        return precision_warning("camera '" + shortened(shot.camera.name) + "'", camera, shot.config.depth_format,
                                 depths.farthest, how_to_push_out);
    };
    const auto may_cut = [&](const DepthRange& depths) {
        return !depths.is_empty() && (depths.nearest < frame.camera.near || depths.farthest >= frame.camera.far);
    };
    DepthRange depths = depths_of_boxes(shot.scene, frame.scene, frame.camera);
    if (!may_cut(depths) && precision(depths).empty()) return {};
    depths = depths_in_view(shot.scene, frame.scene, frame.camera, shot.config.extent);
    std::vector<SceneWarning> warnings;
    for (const std::string& text : {may_cut(depths) ? cut_warning(shot, frame) : "", precision(depths)})
        if (!text.empty()) warnings.push_back({.text = text});
    return warnings;
}
