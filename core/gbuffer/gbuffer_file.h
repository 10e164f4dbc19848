#pragma once
#include "core/host_image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A G-buffer on the CPU: what GBuffer holds on the GPU, pixel for pixel and channel for channel.
struct HostGBuffer {
    CameraData camera{};
    DepthFormat depth_format = DepthFormat::d32f;
    float exposure_ev = 0;               ///< for display: radiance times 2^EV
    HostImage depth;                     ///< 1 channel
    HostImage geometric_normal;          ///< 4
    HostImage normal;                    ///< 4
    HostImage base_color;                ///< 4
    HostImage emission;                  ///< 4
    HostImage motion;                    ///< 2
    HostImage material_id;               ///< 1: whole numbers up to 2^24
    HostImage previous_depth;            ///< 1
    HostImage previous_normal;           ///< 4
    HostImage lit, fallback;             ///< 4; of zero extent where absent
    HostImage second_depth, back_depth;  ///< 1; of zero extent where absent; no file holds them
    HostImage lit_without_specular;      ///< 4; the same
    HostImage dielectric_f0;             ///< 4; of zero extent where it is 0.04 for all surfaces and colours

    glm::uvec2 extent() const { return depth.extent; }
};

/// How many values of each layer are NaN or infinite; layers without any are left out. Keys are the layers of
/// gbuffer.exr, but roughness counts as normal, metalness as base_color and specular as emission.
std::map<std::string, size_t> count_non_finite(const HostGBuffer& gbuffer);

/// A folder with gbuffer.exr and camera.json, so that captures of other engines can stand in for a scene. All images
/// are float32 or half, of one extent, pixel for pixel in screen order (first row at the top). The picture is the
/// display window; how its channels are found is in gbuffer_layers.h.
///
/// gbuffer.exr has the layers of gbuffer_layers(), and camera.json the keys of camera_file_keys(). The keys that follow
/// from others are written so that ssrlab's own files come back bit by bit.
void save_gbuffer(const std::filesystem::path& folder, const HostGBuffer& gbuffer);

struct LoadedGBuffer {
    HostGBuffer gbuffer;
    std::vector<std::string> layers;            ///< layers of save_gbuffer() that the file has
    std::map<std::string, std::string> absent;  ///< what replaces each layer that the file lacks, by its name
    std::vector<std::string> notes;             ///< one sentence each: unused layers, and results of check_gbuffer()
};

/// Fails with Error, naming file and layer, if something required is missing or malformed, or if extents differ.
LoadedGBuffer load_gbuffer(const std::filesystem::path& folder);

/// Writes environment.json, with the keys of a scene file's "environment" (scenes/README.md), and an image to
/// environment.exr. All reads back bit by bit, except the rotation of an image, which is stored in degrees.
void save_environment(const std::filesystem::path& folder, const Environment& environment);
/// None if the folder has no environment.json. `notes` gets a sentence for each conversion. Fails with Error if the
/// file is malformed.
std::optional<Environment> load_environment(const std::filesystem::path& folder, std::vector<std::string>& notes);
