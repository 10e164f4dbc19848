#include "experiments/store/stale_files.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

/// Adds the files that entries of `images` name, as far as they can be images of a results folder.
void add_files(std::set<std::string>& files, const json& images) {
    if (!images.is_array()) return;
    const auto add = [&](const json& name) {
        if (!name.is_string()) return;
        const fs::path file = fs::path(name.get<std::string>()).lexically_normal();
        const bool is_inside = file.is_relative() && *file.begin() == "images" && std::ranges::distance(file) > 1;
        if (is_inside && std::ranges::count(file, fs::path("..")) == 0) files.insert(file.string());
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
        stale.cells.push_back(name);
        if (const auto cell = cells.read(name)) add_files(known, cell->images);  // unless another process removed it
    }
    if (before.is_object()) {
        add_files(known, before.value("images", json::array()));
        if (before.contains("stale") && before["stale"].is_object())
            add_files(known, before["stale"].value("images", json::array()));
    }
    add_files(current, manifest.at("images"));
    for (const std::string& file : known) {
        std::error_code error;
        if (!current.contains(file) && fs::symlink_status(results / file, error).type() == fs::file_type::regular)
            stale.images.push_back(file);
    }
    return stale;
}

void remove_stale_files(const fs::path& results, const CellStore& cells, const StaleFiles& stale) {
    std::error_code error;
    for (const std::string& name : stale.cells) fs::remove(cells.file(name), error);
    for (const std::string& file : stale.images) {
        fs::remove(results / file, error);
        fs::remove((results / file).parent_path(), error);  // fails where something is left
    }
}
