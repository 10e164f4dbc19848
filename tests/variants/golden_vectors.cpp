#include "tests/variants/golden_vectors.h"

#include "core/error.h"

#include <algorithm>
#include <cstdlib>
#include <set>

namespace {

const nlohmann::json& index_files() {
    static const nlohmann::json index = read_json(golden_folder() / "index.json");
    return index["files"];
}

const nlohmann::json* find_entry(const std::string& file) {
    for (const nlohmann::json& entry : index_files())
        if (entry["file"] == file) return &entry;
    return nullptr;
}

std::set<std::string> channels_of_layers(const LayeredImage& image) {
    std::set<std::string> names;
    for (const Layer& layer : image.layers)
        for (const char channel : layer.channel_names)
            names.insert((layer.name.empty() ? "" : layer.name + ".") + channel);
    return names;
}

/// Recorded row by row, for column vectors.
glm::dmat4 matrix(const nlohmann::json& rows) {
    glm::dmat4 m;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) m[column][row] = rows[size_t(row)][size_t(column)];
    return m;
}

glm::dmat4 flip(glm::dvec3 signs) {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis) m[axis][axis] = signs[axis];
    return m;
}

}  // namespace

std::filesystem::path golden_folder() {
    const char* folder = std::getenv("SSRLAB_VECTORS");
    return folder ? folder : SSRLAB_SOURCE_DIR "/tests/data/vectors";
}

std::vector<std::string> golden_files(const std::string& prefix) {
    std::vector<std::string> files;
    for (const nlohmann::json& entry : index_files())
        if (const std::string file = entry["file"]; file.starts_with(prefix)) files.push_back(file);
    return files;
}

std::vector<std::string> golden_sets(const std::string& prefix) {
    std::vector<std::string> sets;
    for (const std::string& file : golden_files(prefix)) {
        std::filesystem::path folder = std::filesystem::path(file).parent_path();
        while (!folder.empty() && !exists(golden_folder() / folder / "meta.json")) folder = folder.parent_path();
        if (folder.empty()) fail(file, " of the index lies in no folder with a meta.json");
        if (std::ranges::find(sets, folder.string()) == sets.end()) sets.push_back(folder.string());
    }
    return sets;
}

bool is_golden(const std::string& file) { return find_entry(file); }

bool has_all_golden_kinds() { return std::getenv("SSRLAB_VECTORS"); }

std::vector<std::string> golden_names(const std::string& prefix, const std::vector<std::string>& names) {
    std::vector<std::string> found = names;
    std::erase_if(found, [&](const std::string& name) { return !is_golden(prefix + name + ".exr"); });
    if (found.empty()) fail("none of the files ", prefix, "*.exr in ", golden_folder().string(), "/index.json");
    return found;
}

LayeredImage read_golden(const std::string& file) {
    const nlohmann::json* entry = find_entry(file);
    if (!entry) fail("no file '", file, "' in ", golden_folder().string(), "/index.json");
    const std::filesystem::path path = golden_folder() / file;
    if (!exists(path)) fail(path.string(), " is in the index, but missing");
    if (file_size(path) != (*entry)["bytes"])
        fail(path.string(), " has ", file_size(path), " bytes; the index says ", (*entry)["bytes"].dump());
    LayeredImage image = read_exr(path);
    const glm::uvec2 extent = image.layers.front().image.extent;
    if ((*entry)["size"] != nlohmann::json{extent.x, extent.y})
        fail(path.string(), " is ", extent.x, "x", extent.y, "; the index says ", (*entry)["size"].dump());
    if (channels_of_layers(image) != (*entry)["channels"].get<std::set<std::string>>())
        fail(path.string(), " has other channels than the index says: ", (*entry)["channels"].dump());
    return image;
}

const HostImage& golden_layer(const LayeredImage& image, const std::string& name) {
    const Layer* layer = image.find(name);
    if (!layer) fail("no layer '", name, "' in the golden image");
    return layer->image;
}

nlohmann::json golden_meta(const std::string& set) { return read_json(golden_folder() / set / "meta.json"); }

CameraData golden_camera(const nlohmann::json& meta, const nlohmann::json& camera, unsigned index) {
    // The column of z holds what clip w takes from it: -1 where the view looks along -z as ours does, else 1.
    const double forward = matrix(camera["projection"])[2][3];
    const glm::dmat4 y_flip = flip({1, -1, 1}), z_flip = flip({1, 1, -forward});
    const glm::dmat4 projection = matrix(camera["projection"]) * z_flip, view = z_flip * matrix(camera["view"]),
                     previous_view = z_flip * matrix(camera["prev_view"]);
    const float width = meta["width"], height = meta["height"];
    const float near = meta["conventions"]["near"], far = meta["conventions"]["far"];
    const bool is_reversed = projection[2][2] > -0.5;  // -far / (far - near) of standard depth is at most -1

    CameraData data{};
    data.clip_from_view = y_flip * projection;
    data.view_from_clip = z_flip * matrix(camera["inverse_projection"]) * y_flip;
    data.view_from_world = view;
    data.world_from_view = matrix(camera["inverse_view"]) * z_flip;
    data.clip_from_world = y_flip * projection * view;
    data.world_from_clip = (camera.contains("inverse_view_projection")
                                ? matrix(camera["inverse_view_projection"])
                                : matrix(camera["inverse_view"]) * matrix(camera["inverse_projection"])) *
                           y_flip;
    data.previous_clip_from_world = y_flip * matrix(camera["prev_view_projection"]);
    data.previous_view_from_world = previous_view;
    data.previous_world_from_view = inverse(previous_view);
    data.previous_view_from_clip = data.view_from_clip;
    data.extent = {width, height, 1 / width, 1 / height};
    data.depth = {near, far, is_reversed ? 0 : 1, is_reversed};
    data.frame = {index, 0, 0, index > 0};
    return data;
}

std::string golden_test_name(const std::string& set) {
    std::string name = set;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}
