#include "core/gbuffer/gbuffer_file.h"

#include "core/error.h"
#include "core/exr.h"
#include "core/files.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_checks.h"
#include "core/json.h"
#include "core/near_miss.h"
#include "core/parameters.h"
#include "core/path_inside.h"
#include "core/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

/// One layer of the file: some consecutive channels of one image of the G-buffer.
struct LayerMap {
    const char *name, *channels;
    HostImage HostGBuffer::*image;
    unsigned first_channel, image_channels;
    bool is_required = false;
    PixelType type = PixelType::float32;
};

using G = HostGBuffer;
const LayerMap layer_maps[] = {
    {"depth", "Z", &G::depth, 0, 1, true},
    {"normal", "XYZ", &G::normal, 0, 4, true},
    {"roughness", "Y", &G::normal, 3, 4, true},
    {"base_color", "RGB", &G::base_color, 0, 4, true},
    {"metalness", "Y", &G::base_color, 3, 4, true},
    {"lit", "RGB", &G::lit, 0, 4},
    {"geometric_normal", "XYZ", &G::geometric_normal, 0, 4},
    {"emission", "RGB", &G::emission, 0, 4},
    {"specular", "Y", &G::emission, 3, 4},
    {"dielectric_f0", "RGB", &G::dielectric_f0, 0, 4},
    {"motion", "XY", &G::motion, 0, 2},
    {"material_id", "Y", &G::material_id, 0, 1, false, PixelType::uint32},
    {"previous_depth", "Z", &G::previous_depth, 0, 1},
    {"previous_normal", "XYZ", &G::previous_normal, 0, 4},
    {"previous_roughness", "Y", &G::previous_normal, 3, 4},
    {"fallback", "RGB", &G::fallback, 0, 4},
};

void copy_channels(const HostImage& from, unsigned from_channel, HostImage& to, unsigned to_channel, unsigned count) {
    for (size_t i = 0; i < from.pixel_count(); ++i)
        for (unsigned c = 0; c < count; ++c)
            to.values[i * to.channels + to_channel + c] = from.values[i * from.channels + from_channel + c];
}

std::vector<std::string> layer_names() {
    std::vector<std::string> names;
    for (const LayerMap& map : layer_maps) names.push_back(map.name);
    return names;
}

/// Copies the layer of `map` into its image, or leaves it black.
void read_layer(const LayeredImage& file, const LayerMap& map, const std::string& where, HostGBuffer& gbuffer,
                std::set<std::string>& found) {
    const Layer* layer = file.find(map.name);
    if (!layer) {
        if (!map.is_required) return;
        for (const Layer& other : file.layers)
            if (nearest_name(other.name, layer_names()) == map.name)
                fail(where, ": lacks the layer '", map.name, "', but has '", other.name, "'");
        fail(where, ": lacks the layer '", map.name, "'");
    }
    const unsigned count = unsigned(std::string(map.channels).size());
    if (layer->image.channels != count)
        fail(where, ": layer '", map.name, "' has ", layer->image.channels, " channels, but needs ", count, " (",
             map.channels, ")");
    if (layer->image.extent != glm::uvec2(gbuffer.camera.extent))
        fail(where, ": is ", layer->image.extent.x, " x ", layer->image.extent.y, ", but camera.json says ",
             gbuffer.camera.extent.x, " x ", gbuffer.camera.extent.y);
    HostImage& image = gbuffer.*map.image;
    if (image.values.empty()) image = HostImage(layer->image.extent, map.image_channels);
    copy_channels(layer->image, 0, image, map.first_channel, count);
    found.insert(map.name);
}

/// Fills what the file lacks; returns what is taken in its place, by layer.
std::map<std::string, std::string> fill_defaults(HostGBuffer& g, const std::set<std::string>& found) {
    std::map<std::string, std::string> absent;
    const auto missing = [&](const char* layer, const char* text) {
        return !found.contains(layer) && absent.emplace(layer, text).second;
    };
    const auto is_background = [&](size_t i) { return g.depth.values[i] == g.camera.depth.z; };
    const auto ensure = [&](HostImage& image, unsigned channels) {
        if (image.values.empty()) image = HostImage(g.extent(), channels);
    };
    ensure(g.geometric_normal, 4), ensure(g.emission, 4), ensure(g.motion, 2), ensure(g.material_id, 1);
    ensure(g.previous_depth, 1), ensure(g.previous_normal, 4);

    if (missing("geometric_normal", "the shading normal is taken"))
        copy_channels(g.normal, 0, g.geometric_normal, 0, 3);
    missing("emission", "0 is taken");
    missing("motion", "0 is taken");
    missing("fallback", "0 is taken");
    missing("lit", "a reference must provide it");
    if (missing("specular", "1 is taken, and 0 in the background"))
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) g.emission.values[4 * i + 3] = is_background(i) ? 0 : 1;
    if (missing("material_id", "1 is taken, and 0 in the background"))
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) g.material_id.values[i] = is_background(i) ? 0 : 1;
    if (missing("previous_depth", "depth is taken")) g.previous_depth = g.depth;
    if (missing("previous_normal", "normal is taken")) copy_channels(g.normal, 0, g.previous_normal, 0, 3);
    if (missing("previous_roughness", "roughness is taken")) copy_channels(g.normal, 3, g.previous_normal, 3, 1);
    return absent;
}

void note_unused_layers(const LayeredImage& file, std::vector<std::string>& notes) {
    const std::vector<std::string> names = layer_names();
    for (const Layer& layer : file.layers)
        if (std::ranges::find(names, layer.name) == names.end())
            notes.push_back("The layer '" + layer.name + "' is not used" + suggestion(layer.name, names) + ".");
}

}  // namespace

std::map<std::string, size_t> count_non_finite(const HostGBuffer& gbuffer) {
    std::map<std::string, size_t> counts;
    for (const LayerMap& map : layer_maps) {
        if (map.first_channel != 0) continue;  // counted with the image's first layer
        const auto bad = std::ranges::count_if((gbuffer.*map.image).values, [](float v) { return !std::isfinite(v); });
        if (bad > 0) counts[map.name] = size_t(bad);
    }
    return counts;
}

void save_gbuffer(const std::filesystem::path& folder, const HostGBuffer& gbuffer) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail_machine("cannot create the folder ", folder.string(), ": ", error.message());
    LayeredImage file;
    for (const LayerMap& map : layer_maps) {
        const HostImage& image = gbuffer.*map.image;
        if (image.values.empty()) continue;
        const unsigned count = unsigned(std::string(map.channels).size());
        Layer layer{
            .name = map.name, .channel_names = map.channels, .image = HostImage(image.extent, count), .type = map.type};
        copy_channels(image, map.first_channel, layer.image, 0, count);
        file.layers.push_back(std::move(layer));
    }
    file.attributes["ssrlab"] = "G-buffer; camera.json beside this file holds the camera";
    write_exr(folder / "gbuffer.exr", file);
    write_camera(folder / "camera.json", {gbuffer.camera, gbuffer.depth_format, gbuffer.exposure_ev});
}

LoadedGBuffer load_gbuffer(const std::filesystem::path& folder) {
    const CameraFile camera = read_camera(path_inside(folder, "camera.json"));
    const std::filesystem::path file = path_inside(folder, "gbuffer.exr");
    LayeredImage layers = read_exr(file);
    constexpr double floats_per_pixel = 37;  // of a HostGBuffer
    const glm::dvec4 extent(camera.camera.extent);
    layers.memory.add(extent.x * extent.y * floats_per_pixel * sizeof(float), file.string() + ": its layers");
    LoadedGBuffer result;
    result.gbuffer.camera = camera.camera;
    result.gbuffer.depth_format = camera.depth_format;
    result.gbuffer.exposure_ev = camera.exposure_ev;
    std::set<std::string> found;
    for (const LayerMap& map : layer_maps) read_layer(layers, map, file.string(), result.gbuffer, found);
    result.absent = fill_defaults(result.gbuffer, found);
    note_unused_layers(layers, result.notes);
    std::ranges::move(check_gbuffer(result.gbuffer), std::back_inserter(result.notes));
    return result;
}

void save_environment(const std::filesystem::path& folder, const Environment& environment) {
    const auto vector = [](glm::vec3 v) {
        return nlohmann::json{json_number(v.x), json_number(v.y), json_number(v.z)};
    };
    nlohmann::json entry;
    switch (environment.type) {
        case Environment::Type::constant:
            entry["constant"] = vector(environment.color);
            break;
        case Environment::Type::gradient:
            entry["gradient"] = {{"color", vector(environment.color)},
                                 {"slope", vector(environment.slope)},
                                 {"axis", vector(environment.axis)}};
            break;
        case Environment::Type::image:
            write_exr(folder / "environment.exr", environment.latlong);
            entry = {{"image", "environment.exr"}, {"rotation_deg", json_number(glm::degrees(environment.rotation))}};
    }
    write_text(folder / "environment.json", entry.dump(2) + "\n");
}

std::optional<Environment> load_environment(const std::filesystem::path& folder) {
    const std::filesystem::path file = path_inside(folder, "environment.json");
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    const nlohmann::json json = read_json(file);
    return read_environment(JsonObject(json, file.string()), file, {});
}
