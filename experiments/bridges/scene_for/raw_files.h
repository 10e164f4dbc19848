#pragma once
#include "core/host_image.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

/// Formats for programs that read neither glTF nor OpenEXR. All fail with MachineError where the folder cannot be
/// written.

/// The image's values as float32, little endian, as they lie in memory: no header.
void write_raw_floats(const std::filesystem::path& file, const HostImage& image);

/// Radiance's HDR format (RGBE, rows from the top, not packed): 8 bits of mantissa a channel, up to 1.7e38.
void write_hdr(const std::filesystem::path& file, const HostImage& rgb);

/// scene.meshes.json and textures/N.png in `folder`: for each of scene.instances, by the names of instance_names(), its
/// vertices in object space as arrays, as joints and morph targets deform them at `pose`, indices of triangles, and its
/// material's factors and textures.
void write_raw_meshes(const std::filesystem::path& folder, const Scene& scene, const ScenePose& pose,
                      const std::vector<std::string>& names);
