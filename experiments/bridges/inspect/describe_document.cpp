// What a glTF file says of itself, whether or not it can be loaded.
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/scene/gltf/gltf_chunks.h"
#include "experiments/bridges/inspect/describe.h"

namespace fs = std::filesystem;

namespace {

/// The member if it is a text, or an array of texts: nothing here is checked yet.
Description texts_in(const nlohmann::json& object, const char* key) {
    Description texts = Description::array();
    if (!object.is_object() || !object.contains(key)) return texts;
    const nlohmann::json& value = object[key];
    if (value.is_string()) texts.push_back(value.get<std::string>());
    if (value.is_array())
        for (const nlohmann::json& one : value)
            if (one.is_string()) texts.push_back(one.get<std::string>());
    return texts;
}

}  // namespace

Description describe_gltf_document(const fs::path& file) {
    const std::string bytes = read_text(file);
    const nlohmann::json root = parse_json(split_chunks(bytes, file.string()).json, file.string());
    const nlohmann::json asset = root.is_object() ? root.value("asset", nlohmann::json()) : nlohmann::json();
    Description counts = Description::object();
    for (const char* list : {"scenes", "nodes", "meshes", "materials", "textures", "images", "cameras", "animations",
                             "skins", "accessors", "buffers"})
        if (root.is_object() && root.contains(list) && root[list].is_array()) counts[list] = root[list].size();
    return {{"file", file.string()},
            {"format", bytes.starts_with("glTF") ? "binary glTF" : "glTF"},
            {"version", texts_in(asset, "version")},
            {"generator", texts_in(asset, "generator")},
            {"bytes", bytes.size()},
            {"extensions_used", texts_in(root, "extensionsUsed")},
            {"extensions_required", texts_in(root, "extensionsRequired")},
            {"counts", counts}};
}
