#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// The name of a folder with a view's images: SCENE.CAMERA.WIDTHxHEIGHT.
struct ViewName {
    std::string scene;  ///< as configs name it: "room_17" gives room:17, unless a scene folder has that name
    std::string camera;
};

/// The scene and camera of "SCENE.CAMERA". Both names may contain dots: the longest scene of the search path that fits
/// wins, and among several the longest with such a camera. Fails with Error where none fits; `view` begins the message.
ViewName view_name(const std::string& names, const std::filesystem::path& view,
                   const std::vector<std::filesystem::path>& search_path);
