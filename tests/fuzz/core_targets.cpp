// The readers of images, scenes and captures.
#include "core/exr.h"
#include "core/files.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/png.h"
#include "core/scene/load_scene.h"
#include "tests/fuzz/targets.h"

namespace fs = std::filesystem;

namespace {

void load(const fs::path& file) { load_scene(file.string(), {}); }

/// A mesh that shows the image, and one that a scene file may name.
void copy_neighbours(const fs::path& folder) {
    fs::copy(fs::path(SSRLAB_SOURCE_DIR) / "tests/data/fuzz/neighbours", folder);
}

const FuzzTarget targets[] = {
    {"scene", "scene.json", load, copy_neighbours},
    {"gltf", "input.gltf", load},
    {"glb", "input.glb", load},
    {"texture", "texture.bin", [](const fs::path& file) { load(file.parent_path() / "shows_texture.gltf"); },
     copy_neighbours},
    {"exr", "input.exr", [](const fs::path& file) { read_exr(file); }},
    {"png", "input.png", [](const fs::path& file) { read_png_codes(file); }},
    {"camera", "camera.json", [](const fs::path& file) { read_camera(file); }},
    {"environment", "environment.json", [](const fs::path& file) { load_environment(file.parent_path()); },
     copy_neighbours},
};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return targets; }
