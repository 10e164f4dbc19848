#pragma once
#include "core/reading_limits.h"
#include "core/scene/scene.h"

#include <tiny_gltf.h>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

/// A property that KHR_animation_pointer moves.
struct AnimatedProperty {
    std::string animation, pointer;  ///< name of the animation; JSON pointer (RFC 6901) to the property
};

/// A parsed glTF file. The files gltf_*.cpp turn its parts into those of a Scene.
struct GltfFile {
    std::filesystem::path path;
    tinygltf::Model model;  ///< without the bytes of buffers and images, for which see `buffers` and read_image_file()
    std::vector<std::span<const uint8_t>> buffers;          ///< of model.bufferViews; empty where no view shows one
    std::vector<std::shared_ptr<const std::string>> bytes;  ///< what `buffers` point into
    std::vector<std::array<unsigned, 2>> uv_sets;           ///< per material: n of the TEXCOORD_n in Vertex::uv
    std::set<SceneWarning> warnings;
    std::vector<AnimatedProperty> animated_properties;
    MemoryShare memory = {};  ///< of the file and its buffers, until they are a Scene

    std::string name() const { return path.string(); }
    std::filesystem::path folder() const { return path.parent_path().empty() ? "." : path.parent_path(); }
    /// Keeps the bytes as long as this GltfFile lives.
    std::span<const uint8_t> keep(std::string text);
    /// Adds another buffer, after those of the file.
    void add_buffer(std::string text) { buffers.push_back(keep(std::move(text))); }
    void warn(const std::string& text, int material = -1, int node = -1) { warnings.insert({text, material, node}); }
};

/// Reads a .gltf or .glb and checks what tinygltf 2.7 takes on trust. tinygltf gets the JSON without buffers and
/// images, which it would read by rules of its own. Fails with Error if the file or a buffer that is used is missing,
/// truncated or malformed, or if the file requires an extension that load_gltf() does not know.
GltfFile read_gltf(const std::filesystem::path& path);

/// The encoded bytes of an image, from its file, data URI or buffer view.
struct ImageFile {
    std::string owned;  ///< bytes of a file or data URI
    std::span<const uint8_t> bytes;
    MemoryShare memory = {};

    ImageFile() = default;
    ImageFile(const ImageFile&) = delete;  // `bytes` may point into `owned`
    ImageFile& operator=(const ImageFile&) = delete;
};
/// Fills `image` with image `index`. Fails with Error if it is missing or cannot be read.
void read_image_file(const GltfFile& file, size_t index, ImageFile& image);

/// "a.gltf: image 2 ('wood.png')".
std::string image_title(const GltfFile& file, size_t index);

/// `index` as an index into a list of `count`, or an Error such as "a.gltf: mesh 2 names material 7, but there are 3".
size_t checked_index(const GltfFile& file, int index, size_t count, const std::string& what);

/// Elements of an accessor as floats, `components` each; normalised integers are mapped to [0, 1] or [-1, 1] (glTF 2.0,
/// section 3.11). Zeros without a buffer view; sparse accessors are filled in. Fails where the accessor leaves its
/// buffer or a value is not finite.
std::vector<float> read_floats(const GltfFile& file, int accessor, unsigned components, const std::string& what);

/// Elements of an accessor of unsigned integers, `components` each; otherwise as read_floats().
std::vector<uint32_t> read_indices(const GltfFile& file, int accessor, const std::string& what,
                                   unsigned components = 1);
