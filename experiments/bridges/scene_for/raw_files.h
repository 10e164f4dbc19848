#pragma once
#include "core/host_image.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

/// Formats for programs that read neither glTF nor OpenEXR. All functions fail with MachineError if the folder cannot
/// be written.

/// Writes the values as float32, little endian, in memory order, without a header.
void write_raw_floats(const std::filesystem::path& file, const HostImage& image);

/// Writes Radiance's HDR format (RGBE, rows from the top, uncompressed): 8 bits of mantissa a channel, up to 1.7e38.
void write_hdr(const std::filesystem::path& file, const HostImage& rgb);

/// Writes scene.meshes.json and textures/N.png into `folder`. Each of scene.instances has its name of `names`
/// (instance_names()), vertices, triangles, and its material's factors and textures. Vertices are in object space,
/// deformed by joints and morph targets at `pose`.
void write_raw_meshes(const std::filesystem::path& folder, const Scene& scene, const ScenePose& pose,
                      const std::vector<std::string>& names);
