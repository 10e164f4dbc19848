#include "experiments/results/cells/stale_files.h"

#include "core/error.h"
#include "experiments/results/cells/image_path.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

/// Adds the files that entries of `images` name, as far as they can be images of the folder.
void add_files(std::set<std::string>& files, const json& images, const fs::path& results) {
    if (!images.is_array()) return;
    const auto add = [&](const json& name) {
        if (name.is_string()) try {
                files.insert(image_path(results, name).lexically_relative(results).lexically_normal().string());
            } catch (const Error&) {  // no image of this folder
            }
    };
    for (const json& image : images) {
        add(image);
        if (!image.is_object()) continue;
        for (const char* kind : {"exr", "png"})
            if (image.contains(kind)) add(image[kind]);
    }
}

}  // namespace

StaleFiles find_stale_files(const fs::path& results, const CellStore& cells, const std::set<std::string>& used,
                            const json& manifest, const json& before) {
    StaleFiles stale;
    std::set<std::string> known, current;
    for (const std::string& name : cells.names()) {
        if (used.contains(name)) continue;
        const std::optional<Cell> cell = cells.read(name);
        if (!cell) continue;  // none of ours, or another process removed it
        stale.cells.push_back(name);
        add_files(known, cell->images, results);
    }
    if (before.is_object()) {
        add_files(known, before.value("images", json::array()), results);
        if (before.contains("stale") && before["stale"].is_object())
            add_files(known, before["stale"].value("images", json::array()), results);
    }
    add_files(current, manifest.at("images"), results);
    for (const std::string& file : known) {
        std::error_code error;
        if (!current.contains(file) && fs::is_regular_file(image_path(results, file), error))
            stale.images.push_back(file);
    }
    return stale;
}

void remove_stale_files(const fs::path& results, const CellStore& cells, const StaleFiles& stale) {
    std::error_code error;
    for (const std::string& name : stale.cells) fs::remove(cells.file(name), error);
    for (const std::string& file : stale.images) {
        const fs::path path = image_path(results, file);
        fs::remove(path, error);
        fs::remove(path.parent_path(), error);  // fails where something is left
    }
}
