#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// What the folder of a view's images is called after: SCENE.CAMERA.WIDTHxHEIGHT.
struct ViewName {
    std::string scene;  ///< as configs name it: room:17 of "room_17", unless a folder of scenes has that name
    std::string camera;
};

/// The scene and the camera of "SCENE.CAMERA". Both names may have dots in them, so that the scenes of the search path
/// decide: the longest that fits, and of several that do the longest that has such a camera. Fails with Error where
/// none fits; `view` begins the message.
ViewName view_name(const std::string& names, const std::filesystem::path& view,
                   const std::vector<std::filesystem::path>& search_path);
