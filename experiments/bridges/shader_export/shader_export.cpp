#include "experiments/bridges/shader_export/shader_export.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/bridges/shader_export/export_description.h"
#include "experiments/bridges/shader_export/export_page.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* maker = "ssrlab export-shaders";

/// passes.json of an earlier export; null if the folder holds none.
json earlier_export(const fs::path& folder) {
    const fs::path file = path_inside(folder, "passes.json");
    if (!fs::is_regular_file(file)) return {};
    const json found = read_json(file);
    return found.is_object() && found.value("made_by", json()) == maker ? found : json();
}

void remove_earlier(const fs::path& folder) {
    const json earlier = earlier_export(folder);
    if (earlier.is_null()) return;
    for (const json& name : earlier.value("written", json::array()))
        if (name.is_string()) fs::remove(path_inside(folder, name.get<std::string>(), "passes.json"));
}

}  // namespace

void check_export_folder(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) return;
    if (!fs::is_directory(folder)) fail(folder.string(), " is no folder; choose another name for --out");
    if (!fs::is_empty(folder) && earlier_export(folder).is_null())
        fail(folder.string(), " is not empty, and no export of ssrlab; choose another folder for --out, or empty it");
}

size_t export_shaders(Device& device, const ExportRequest& request, const fs::path& folder) {
    check_export_folder(folder);
    ShaderExport made =
        describe_export(request.point, frame_passes(device, request.point, request.screen, request.scene_path),
                        frame_passes(device, request.point, 2u * request.screen + 1u, request.scene_path));
    made.description["made_by"] = maker;
    made.files["README.md"] = export_page(made.description);
    for (const auto& [name, text] : made.files) made.description["written"].push_back(name);
    create_folder(folder);
    remove_earlier(folder);
    for (const auto& [name, text] : made.files) write_text(path_inside(folder, name), text);
    write_text(path_inside(folder, "passes.json"), made.description.dump(2) + '\n');
    return made.description.at("files").size();
}
