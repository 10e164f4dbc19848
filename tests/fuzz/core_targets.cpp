// The readers of images, scenes, captures and compiled shaders.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/exr/exr_picture.h"
#include "core/files.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/gpu/pipelines/glsl_compiler/shader_rules.h"
#include "core/png.h"
#include "core/radiance_hdr.h"
#include "core/scene/load_scene.h"
#include "tests/fuzz/targets.h"

#include <zlib.h>
#include <algorithm>
#include <cstdint>
#include <fstream>

namespace fs = std::filesystem;

namespace {

void load(const fs::path& file) { load_scene(file.string(), {}); }

/// A mesh that shows the image, and one that a scene file may name.
void copy_neighbours(const fs::path& folder) {
    fs::copy(fs::path(SSRLAB_SOURCE_DIR) / "tests/data/fuzz/neighbours", folder);
}

/// The camera of the inputs of "capture", which are 6 x 4 pixels.
void write_capture_camera(const fs::path& folder) {
    write_camera(folder / "camera.json", {camera_data({}, nullptr, {.extent = {6, 4}})});
}

/// Gives the chunks of a PNG file right checksums, since else hardly a change would get past libpng's look at them. A
/// chunk is the length of its data (4 bytes, the greatest first), a type (4), the data, and a checksum of type and data
/// (4); they follow a signature of 8 bytes.
void correct_checksums(const fs::path& file) {
    std::string bytes = read_text(file);
    constexpr size_t around_data = 12;
    const auto byte = [&](size_t at) { return size_t(uint8_t(bytes[at])); };
    for (size_t at = 8; at + around_data <= bytes.size();) {
        const size_t length = byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
        if (length > bytes.size() - at - around_data) break;
        const char* type_and_data = bytes.data() + at + 4;
        const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(type_and_data), uInt(4 + length));
        for (int i = 0; i < 4; ++i) bytes[at + 8 + length + size_t(i)] = char(checksum >> (24 - 8 * i));
        at += around_data + length;
    }
    std::ofstream(file, std::ios::binary) << bytes;  // write_text() renames, which is slower
}

/// Fails with Error if the shader asks for what no device has.
void read_spirv(const fs::path& file) {
    const std::string bytes = read_text(file);
    std::vector<unsigned> words(bytes.size() / sizeof(unsigned));
    std::copy_n(bytes.data(), words.size() * sizeof(unsigned), reinterpret_cast<char*>(words.data()));
    for (const std::string& name : foreign_capabilities(words)) fail(name);
}

const FuzzTarget targets[] = {
    {"scene", "scene.json", load, copy_neighbours},
    {"gltf", "input.gltf", load},
    {"glb", "input.glb", load},
    {"texture", "texture.bin",
     [](const fs::path& file) {
         if (read_text(file).starts_with("\x89PNG")) correct_checksums(file);
         load(file.parent_path() / "shows_texture.gltf");
     },
     copy_neighbours},
    {"exr", "input.exr",
     [](const fs::path& file) {
         try {
             read_exr_picture(file);
         } catch (const Error&) {
         }
         read_exr(file);
     }},
    {"capture", "gbuffer.exr", [](const fs::path& file) { load_gbuffer(file.parent_path()); }, write_capture_camera},
    {"png", "input.png",
     [](const fs::path& file) {
         correct_checksums(file);
         read_png_codes(file);
     }},
    {"radiance", "input.hdr",
     [](const fs::path& file) {
         std::vector<std::string> notes;
         read_radiance_hdr(file, notes);
     }},
    {"spirv", "shader.spv", read_spirv},
    {"camera", "camera.json", [](const fs::path& file) { read_camera(file); }},
    {"environment", "environment.json",
     [](const fs::path& file) {
         std::vector<std::string> notes;
         load_environment(file.parent_path(), notes);
     },
     copy_neighbours},
};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return targets; }
