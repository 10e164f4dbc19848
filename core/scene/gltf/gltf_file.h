#pragma once
#include "core/reading_limits.h"
#include "core/scene/scene.h"

#include <tiny_gltf.h>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

/// A parsed glTF file with all its buffers; images are still encoded (tinygltf::Image::image holds the bytes of the PNG
/// or JPEG). The files gltf_*.cpp turn its parts into those of a Scene.
struct GltfFile {
    std::filesystem::path path;
    tinygltf::Model model;
    std::set<SceneWarning> warnings;
    MemoryShare memory = {};         ///< of the file, its buffers and encoded images, until they are a Scene

    std::string name() const { return path.string(); }
    void warn(const std::string& text, int material = -1, int node = -1) { warnings.insert({text, material, node}); }
};

/// Reads and checks what tinygltf 2.7 takes on trust: the chunks of a .glb, and that buffer views and the images in
/// them lie inside their buffers. Fails with Error if the file or a buffer is missing, truncated or malformed, or if
/// the file requires an extension that load_gltf() does not know.
GltfFile read_gltf(const std::filesystem::path& path);

/// `index` as an index into a list of `count`, or an Error such as "a.gltf: mesh 2 names material 7, but there are 3".
size_t checked_index(const GltfFile& file, int index, size_t count, const std::string& what);

/// Elements of an accessor as floats, `components` each; normalised integers are mapped to [0, 1] or [-1, 1] (glTF 2.0,
/// section 3.11). Sparse accessors are filled in. Fails where the accessor leaves its buffer or a value is not finite.
std::vector<float> read_floats(const GltfFile& file, int accessor, unsigned components, const std::string& what);

/// Elements of a scalar accessor of unsigned integers.
std::vector<uint32_t> read_indices(const GltfFile& file, int accessor, const std::string& what);
