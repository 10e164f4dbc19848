#pragma once
#include "core/scene/scene.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// What ssrlab understands of a file or folder, as a JSON object whose "kind" says what it is. Lengths are in metres,
/// angles in degrees, light in W and sr. page_of() (page.h) makes a page of text of it.
using Description = nlohmann::ordered_json;

struct Inspected {
    Description description;
    std::optional<Scene> scene;  ///< if it is one
    std::string refusal = {};    ///< why it cannot be used, where more than that is known of it: `description`; else ""
};

/// Of whatever `name` is: an image, a capture's folder, a folder of an engine's frames, or a
/// scene as load_scene() takes it. Fails with Error where it is none of these, or where nothing of it can be read.
Inspected inspect(const std::string& name, const std::vector<std::filesystem::path>& search_path);

/// Of an OpenEXR, PNG, JPEG, WebP or Radiance file, whichever its bytes say.
Description describe_image(const std::filesystem::path& file);
/// Without `reads_pixels` by the header alone: no ranges of channels.
Description describe_exr(const std::filesystem::path& file, bool reads_pixels = true);

Description describe_scene(const Scene& scene);

/// What a .gltf or .glb says of itself: program, extensions, how many of what. Fails with Error where its JSON cannot
/// be read; needs not be valid glTF otherwise.
Description describe_gltf_document(const std::filesystem::path& file);

/// `folder`: as Capture takes it.
Description describe_capture(const std::filesystem::path& folder);
/// `folder`: as read_external_images() takes it.
Description describe_external_frames(const std::filesystem::path& folder,
                                     const std::vector<std::filesystem::path>& search_path);
