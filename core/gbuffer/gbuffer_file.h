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
/// gbuffer.exr: layer (channels)    meaning                                                   if absent
///   depth (Z)                      device depth of camera.json's direction and format; the   required
///                                  far plane's value where nothing was drawn
///   normal (X Y Z)                 unit shading normal, world space, +Y up                   required
///   roughness (Y)                  perceptual: GGX alpha = roughness^2                       required
///   base_color (R G B)             linear Rec.709                                            required
///   metalness (Y)                                                                            required
///   lit (R G B)                    emitted and diffusely reflected radiance, linear; the     a reference must
///                                  environment where nothing was drawn                       provide it
///   geometric_normal (X Y Z)       unit normal of the triangle, towards the camera           normal
///   emission (R G B)               emitted radiance                                          0
///   specular (Y)                   scales what dielectrics reflect: at normal incidence      1; 0 in the background
///                                  dielectric_f0, at grazing incidence 1; 0: nothing
///   dielectric_f0 (R G B)          what dielectrics reflect at normal incidence, from 0 to   0.04
///                                  1; an index of refraction n gives ((n - 1) / (n + 1))^2
///   motion (X Y)                   uv now - uv before (0..1 over the screen, y down),        0
///                                  without jitter
///   material_id (Y)                whole number (uint32 or float), 0 in the background       1; 0 in the background
///   previous_depth (Z)             as depth, of the frame before                             depth
///   previous_normal (X Y Z), previous_roughness (Y)                                          normal, roughness
///   fallback (R G B)               radiance to reflect where the technique finds nothing     0
///
/// camera.json: "extent" [width, height], "depth_direction" "standard" or "reversed", "depth_format" "d32f", "d24" or
/// "d16", "near" and "far" (m), "clip_from_view" and "view_from_world" (each four rows of four numbers; Vulkan clip
/// space: y down, z in [0, 1]; without jitter). Optional: "frame" and "seed" (0), "is_orthographic" (false), "jitter"
/// and "previous_jitter" (pixels, [0, 0]), "previous_clip_from_view" and "previous_view_from_world" (of the frame
/// before; both or none), "exposure_ev" (0: FLIP and pictures show radiance times 2^EV), and what is derived from them:
/// "view_from_clip", "world_from_view", "clip_from_world", "world_from_clip", "previous_clip_from_world",
/// "previous_world_from_view", "previous_view_from_clip", which ssrlab writes so that its own files come back bit by
/// bit.
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
