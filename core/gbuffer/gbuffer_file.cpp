#include "core/gbuffer/gbuffer_file.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_checks.h"
#include "core/gbuffer/gbuffer_layers.h"
#include "core/json.h"
#include "core/parameters.h"
#include "core/path_inside.h"
#include "core/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

/// Fills what the file lacks; returns what is taken in its place, by layer.
std::map<std::string, std::string> fill_defaults(HostGBuffer& g, const std::set<std::string>& found) {
    std::map<std::string, std::string> absent;
    for (const GBufferLayer& layer : gbuffer_layers())
        if (!found.contains(layer.name) && layer.image != &HostGBuffer::dielectric_f0)  // which empty stands for 0.04
            absent[layer.name] = layer.if_absent;
    const auto is_background = [&](size_t i) { return g.depth.values[i] == g.camera.depth.z; };
    const auto ensure = [&](HostImage& image, unsigned channels) {
        if (image.values.empty()) image = HostImage(g.extent(), channels);
    };
    ensure(g.geometric_normal, 4), ensure(g.emission, 4), ensure(g.motion, 2), ensure(g.material_id, 1);
    ensure(g.previous_depth, 1), ensure(g.previous_normal, 4);

    if (absent.contains("geometric_normal")) copy_channels(g.normal, 0, g.geometric_normal, 0, 3);
    if (absent.contains("specular"))
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) g.emission.values[4 * i + 3] = is_background(i) ? 0 : 1;
    if (absent.contains("material_id"))
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) g.material_id.values[i] = is_background(i) ? 0 : 1;
    if (absent.contains("previous_depth")) g.previous_depth = g.depth;
    if (absent.contains("previous_normal")) copy_channels(g.normal, 0, g.previous_normal, 0, 3);
    if (absent.contains("previous_roughness")) copy_channels(g.normal, 3, g.previous_normal, 3, 1);
    return absent;
}

}  // namespace

std::map<std::string, size_t> count_non_finite(const HostGBuffer& gbuffer) {
    std::map<std::string, size_t> counts;
    for (const GBufferLayer& map : gbuffer_layers()) {
        if (map.first_channel != 0) continue;  // counted with the image's first layer
        const auto bad = std::ranges::count_if((gbuffer.*map.image).values, [](float v) { return !std::isfinite(v); });
        if (bad > 0) counts[map.name] = size_t(bad);
    }
    return counts;
}

void save_gbuffer(const std::filesystem::path& folder, const HostGBuffer& gbuffer) {
    create_folder(folder);
    LayeredImage file;
    for (const GBufferLayer& map : gbuffer_layers()) {
        const HostImage& image = gbuffer.*map.image;
        if (image.values.empty()) continue;
        Layer layer{.name = map.name,
                    .channel_names = map.channels,
                    .image = HostImage(image.extent, map.count()),
                    .type = map.type};
        copy_channels(image, map.first_channel, layer.image, 0, map.count());
        file.layers.push_back(std::move(layer));
    }
    file.attributes["ssrlab"] = "G-buffer; camera.json beside this file holds the camera";
    write_exr(folder / "gbuffer.exr", file);
    write_camera(folder / "camera.json", {gbuffer.camera, gbuffer.depth_format, gbuffer.exposure_ev});
}

LoadedGBuffer load_gbuffer(const std::filesystem::path& folder) {
    const CameraFile camera = read_camera(path_inside(folder, "camera.json"));
    const std::filesystem::path file = path_inside(folder, "gbuffer.exr");
    MemoryShare memory;
    constexpr double floats_per_pixel = 37;  // of a HostGBuffer
    const glm::dvec4 extent(camera.camera.extent);
    memory.add(extent.x * extent.y * floats_per_pixel * sizeof(float), file.string() + ": its layers");
    LoadedGBuffer result;
    result.gbuffer.camera = camera.camera;
    result.gbuffer.depth_format = camera.depth_format;
    result.gbuffer.exposure_ev = camera.exposure_ev;
    FoundLayers found = read_gbuffer_layers(file, result.gbuffer);
    result.absent = fill_defaults(result.gbuffer, found.names);
    result.layers.assign(found.names.begin(), found.names.end());
    result.notes = std::move(found.notes);
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

std::optional<Environment> load_environment(const std::filesystem::path& folder, std::vector<std::string>& notes) {
    const std::filesystem::path file = path_inside(folder, "environment.json");
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    const nlohmann::json json = read_json(file);
    return read_environment(JsonObject(json, file.string()), file, {}, notes);
}
