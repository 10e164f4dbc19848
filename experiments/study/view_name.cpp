#include "experiments/study/view_name.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/scene/scene_family.h"

#include <re2/re2.h>
#include <algorithm>

namespace fs = std::filesystem;

namespace {

bool has_camera(const ViewName& name, const std::vector<fs::path>& search_path) {
    return std::ranges::count(load_scene(name.scene, search_path).cameras, name.camera, &SceneCamera::name) > 0;
}

/// "room:17" of "room_17"; "" of what is no scene of a family.
std::string scene_of_family(std::string name) {
    static const RE2 pattern(R"((\w+)_\d{1,6})");
    std::string family;
    if (!RE2::FullMatch(name, pattern, &family) || !is_of_family(family + ":")) return "";
    name[family.size()] = ':';
    return name;
}

}  // namespace

ViewName view_name(const std::string& names, const fs::path& view, const std::vector<fs::path>& search_path) {
    const std::vector<std::string> known = list_scenes(search_path);
    std::vector<ViewName> fitting;  // the longest scene first
    for (size_t dot = names.rfind('.'); dot != std::string::npos && dot > 0; dot = names.rfind('.', dot - 1))
        if (const std::string start = names.substr(0, dot); std::ranges::count(known, start) > 0)
            fitting.push_back({.scene = start, .camera = names.substr(dot + 1)});
    if (fitting.size() > 1)
        for (const ViewName& name : fitting)
            if (has_camera(name, search_path)) return name;
    if (!fitting.empty()) return fitting.front();
    const size_t dot = names.find('.');
    const std::string scene = names.substr(0, dot), camera = dot == std::string::npos ? "" : names.substr(dot + 1);
    if (const std::string of_family = scene_of_family(scene); !of_family.empty())
        return {.scene = of_family, .camera = camera};
    if (const size_t last = names.rfind('.'); last != std::string::npos && names.substr(last + 1) == camera_of_captures)
        return {.scene = names.substr(0, last), .camera = camera_of_captures, .is_of_capture = true};
    fail(view.string(),
         ": its name is SCENE.CAMERA.WIDTHxHEIGHT, and no known scene begins it: cut at the first dot it ",
         "has the scene '", shortened(scene), "' and the camera '", shortened(camera),
         "'; name the scene with --scene, or its folder with --scene-path", suggestion(scene, known));
}
