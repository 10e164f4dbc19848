#include "experiments/bridges/inspect/describe.h"

#include "core/error.h"
#include "core/image_format.h"
#include "core/reading_limits.h"
#include "core/scene/load_scene.h"
#include "experiments/study/config/shots/plane_warnings.h"
#include "experiments/study/config/shots/scene_warnings.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <span>

namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& file) {
    std::error_code error;
    return fs::exists(file, error);
}

bool holds_capture(const fs::path& folder) {
    if (is_there(folder / "gbuffer.exr")) return true;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().filename().string().starts_with("frame_")) return true;
    return false;
}

/// The first view's planes may cut surfaces, which no reader of files sees.
void add_plane_warnings(Scene& scene) {
    if (scene.cameras.empty()) return;
    Shot shot{.config = {.extent = first_view(scene).extent, .frames = {0}}, .scene = std::move(scene)};
    shot.camera = shot.scene.camera("");
    const std::vector<SceneWarning> warnings = plane_warnings(shot);
    scene = std::move(shot.scene);
    std::ranges::copy(warnings, std::back_inserter(scene.warnings));
}

Inspected inspect_scene(const std::string& name, const std::vector<fs::path>& search_path) {
    Scene scene = load_scene(name, search_path);
    add_plane_warnings(scene);
    Description description = describe_scene(scene);
    return {.description = std::move(description), .scene = std::move(scene)};
}

Inspected inspect_gltf(const fs::path& file, const std::vector<fs::path>& search_path) {
    const Description document = describe_gltf_document(file);
    try {
        Inspected inspected = inspect_scene(file.string(), search_path);
        inspected.description["document"] = document;
        return inspected;
    } catch (const MachineError&) {
        throw;
    } catch (const Error& e) {
        return {.description = {{"kind", "refused scene"}, {"document", document}, {"refusal", e.what()}},
                .scene = {},
                .refusal = e.what()};
    }
}

bool has_ending(const fs::path& file, std::initializer_list<std::string_view> endings) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return std::ranges::find(endings, ending) != endings.end();
}

Inspected inspect_image(const fs::path& file, ImageFormat format) {
    try {
        return {.description = describe_image(file), .scene = {}};
    } catch (const MachineError&) {
        throw;
    } catch (const Error& e) {
        if (format != ImageFormat::exr) throw;
        Description description = describe_exr(file, false);
        description["refusal"] = e.what();
        return {.description = std::move(description), .scene = {}, .refusal = e.what()};
    }
}

Inspected inspect_folder(const fs::path& folder, const std::string& scene, const std::vector<fs::path>& search_path) {
    if (is_there(folder / "external.json"))
        return {.description = describe_external_frames(folder, scene, search_path), .scene = {}};
    if (is_there(folder / "scene.json")) return inspect_scene((folder / "scene.json").string(), search_path);
    if (holds_capture(folder)) return {.description = describe_capture(folder), .scene = {}};
    fail(
        folder.string(),
        " holds none of scene.json (a scene), gbuffer.exr or frame_<number> (a capture) and external.json (an engine's "
        "frames)");
}

}  // namespace

Inspected inspect(const std::string& name, const std::vector<fs::path>& search_path, const std::string& scene) {
    const fs::path path = name;
    std::error_code error;
    if (fs::is_directory(path, error)) return inspect_folder(path, scene, search_path);
    if (!is_there(path)) return inspect_scene(name, search_path);
    check_regular_file(path);
    const std::vector<uint8_t> bytes = first_bytes(name);
    if (const ImageFormat format = image_format(bytes); format != ImageFormat::none) return inspect_image(path, format);
    if (const std::string why = why_unreadable(bytes, name, ImageUse::comparison);
        !why.empty() && !has_ending(path, {".gltf", ".glb", ".json"}))
        fail(name, " ", why);
    return has_ending(path, {".gltf", ".glb"}) ? inspect_gltf(path, search_path) : inspect_scene(name, search_path);
}
