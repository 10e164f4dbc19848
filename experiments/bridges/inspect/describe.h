#pragma once
#include "core/scene/scene.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// What ssrlab understands of a file or folder, as a JSON object; "kind" says what it is. Lengths are in metres, angles
/// in degrees, light in W and sr. page_of() (page.h) turns it into text.
using Description = nlohmann::ordered_json;

struct Inspected {
    Description description;
    std::optional<Scene> scene;  ///< set if it is a scene
    std::string refusal = {};    ///< why it cannot be used, if there is a description all the same; else ""
};

/// Describes `name`: an image, a capture's folder, a folder of an engine's frames, or a scene as load_scene() takes it.
/// `scene`: of an engine's frames, as views_of_frames() takes it. Fails with Error if `name` is none of these, or if
/// nothing of it can be read.
Inspected inspect(const std::string& name, const std::vector<std::filesystem::path>& search_path,
                  const std::string& scene = "");

/// Describes an OpenEXR, PNG, JPEG, WebP or Radiance file, whose bytes tell the format.
Description describe_image(const std::filesystem::path& file);
/// Describes an EXR file. Without `reads_pixels` only its header is read: no ranges of channels.
Description describe_exr(const std::filesystem::path& file, bool reads_pixels = true);

Description describe_scene(const Scene& scene);

/// What a .gltf or .glb says of itself: program, extensions, numbers of objects. It need not be valid glTF. Fails with
/// Error if its JSON cannot be read.
Description describe_gltf_document(const std::filesystem::path& file);

/// `folder`: as Capture takes it.
Description describe_capture(const std::filesystem::path& folder);
/// `folder`: as read_external_images() takes it. `scene`: as views_of_frames() takes it.
Description describe_external_frames(const std::filesystem::path& folder, const std::string& scene,
                                     const std::vector<std::filesystem::path>& search_path);
