#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// The camera of each capture: its views are CAPTURE.gbuffer.WIDTHxHEIGHT.
inline constexpr const char* camera_of_captures = "gbuffer";

/// The name of a folder with a view's images: SCENE.CAMERA.WIDTHxHEIGHT.
struct ViewName {
    std::string scene;  ///< as configs name it: "room_17" gives room:17, unless a scene folder has that name
    std::string camera;
    bool is_of_capture = false;  ///< `scene` is the name of a capture
};

/// The scene and camera of "SCENE.CAMERA". Both names may contain dots: the longest scene of the search path that fits
/// wins, and among several the longest with such a camera. Where none fits, the view of
/// a camera `gbuffer` is that of a capture; of any other it fails with Error, whose message `view` begins.
ViewName view_name(const std::string& names, const std::filesystem::path& view,
                   const std::vector<std::filesystem::path>& search_path);
