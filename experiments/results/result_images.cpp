#include "experiments/results/result_images.h"

#include "core/exr.h"
#include "core/files.h"
#include "core/png.h"
#include "experiments/results/file_name.h"
#include "metrics/color_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace {

/// Writes `rgb` as EXR and `picture` as PNG; the entry names both with the hashes of their bytes.
nlohmann::json save_image(const std::filesystem::path& out, const std::string& folder, const std::string& name,
                          const HostImage& rgb, PixelType type, const HostImage& picture, float exposure_ev,
                          nlohmann::json entry) {
    const std::string stem = "images/" + file_name(folder) + "/" + name;
    write_exr(out / (stem + ".exr"), rgb, type);
    write_png(out / (stem + ".png"), picture, exposure_ev);
    for (const std::string kind : {"exr", "png"}) {
        entry[kind] = stem + "." + kind;
        entry[kind + "_hash"] = file_hash(out / (stem + "." + kind));
    }
    return entry;
}

/// Half floats do: results are looked at, and measured in float32.
nlohmann::json save_image(const std::filesystem::path& out, const std::string& folder, const std::string& name,
                          const HostImage& rgb, float exposure_ev, nlohmann::json entry) {
    return save_image(out, folder, name, rgb, PixelType::half, rgb, exposure_ev, std::move(entry));
}

HostImage repeated_channel(const HostImage& source) {
    HostImage rgb(source.extent, 3);
    for (size_t i = 0; i < rgb.pixel_count(); ++i)
        for (size_t c = 0; c < 3; ++c) rgb.values[i * 3 + c] = source.values[i];
    return rgb;
}

/// What the relative error of an image adds to the reference, so that dark pixels count no more than they are worth.
double relative_error_epsilon(const HostImage& reference) {
    double sum = 0;
    size_t count = 0;
    for (const float v : reference.values)
        if (std::isfinite(v)) sum += v, ++count;
    return std::max(0.01 * sum / double(std::max<size_t>(count, 1)), 1e-20);
}

/// The mean over channels of the errors' sizes with magma from 0 to 1.
HostImage error_picture(const HostImage& error) {
    Plane sizes(error.extent);
    for (size_t i = 0; i < error.values.size(); ++i) sizes.values[i / 3] += std::abs(error.values[i]) / 3.0;
    return false_color(sizes, 1.0);
}

}  // namespace

std::string file_hash(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return "";
    ContentHash hash;
    hash.add(read_text(file));
    return hash.hex();
}

HostImage relative_error(const HostImage& test, const HostImage& reference) {
    const double epsilon = relative_error_epsilon(reference);
    HostImage error(reference.extent, 3);
    for (size_t i = 0; i < error.values.size(); ++i) {
        const double r = reference.values[i], x = test.values[i];
        error.values[i] = float((x - r) / (std::abs(r) + epsilon));
    }
    return error;
}

CompositedImages download_results(PassGraph& graph, const GBuffer& gbuffer, const Reflections& reflections,
                                  const Composite& composite, const HostImage& reflectance) {
    const HostImage radiance = graph.download(reflections.radiance), fallback = graph.download(gbuffer.fallback);
    CompositedImages images{
        .specular = channels_of(graph.download(composite.specular), 0, 3),
        .incident = HostImage(radiance.extent, 3),
        .confidence = channels_of(graph.download(reflections.confidence), reflections.confidence_channel, 1),
        .radiance = HostImage(radiance.extent, 3)};
    for (size_t i = 0; i < radiance.pixel_count(); ++i)
        if (images.confidence.values[i] != 0.0f) images.radiance.set_rgb(i, radiance.rgb(i));
    for (size_t i = 0; i < images.incident.pixel_count(); ++i) {
        if (!reflectance.values.empty() && reflectance.rgb(i) == glm::vec3(0.0f)) continue;
        for (size_t c = 0; c < 3; ++c) {
            const float a = images.confidence.values[i], from = fallback.values[i * fallback.channels + c],
                        to = radiance.values[i * radiance.channels + c];
            images.incident.values[i * 3 + c] = a == 0.0f ? from : from * (1.0f - a) + to * a;
        }
    }
    return images;
}

std::vector<nlohmann::json> save_reference_images(const std::filesystem::path& out, const std::string& shot,
                                                  unsigned frame, const Reference& reference, float exposure_ev) {
    std::vector<nlohmann::json> entries;
    std::vector<std::pair<const char*, const ReferenceOutput*>> outputs = {
        {"image", &reference.image}, {"specular", &reference.specular}, {"incident", &reference.incident}};
    if (!reference.ladder.is_empty()) {
        outputs.push_back({"camera_radiance", &reference.ladder.camera_radiance});
        outputs.push_back({"on_screen", &reference.ladder.on_screen});
    }
    for (const auto& [target, output] : outputs)
        entries.push_back(save_image(
            out, shot, "reference." + reference.hash.substr(0, 8) + "." + target, output->mean, exposure_ev,
            {{"shot", shot}, {"frame", frame}, {"variant", "reference"}, {"kind", "reference"}, {"target", target}}));
    return entries;
}

nlohmann::json save_roughness_image(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                    const HostImage& roughness) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(roughness.values)));
    return save_image(
        out, shot, "surface." + hash.hex().substr(0, 8) + ".roughness", repeated_channel(roughness), 0.0f,
        {{"shot", shot}, {"frame", frame}, {"variant", "reference"}, {"kind", "surface"}, {"target", "roughness"}});
}

nlohmann::json save_verdict_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                  const std::string& stage, const HostImage& map) {
    const std::string name =
        file_name(row.variant + "." + row.point, 150) + ".s" + std::to_string(row.seed) + "." + suffix;
    const nlohmann::json entry = {{"shot", row.shot},       {"frame", std::stoul(row.frame)},
                                  {"variant", row.variant}, {"point", row.point},
                                  {"seed", row.seed},       {"kind", "hits"},
                                  {"target", stage}};
    return save_image(out, row.shot, name + ".hits." + file_name(stage, 60), map, 0.0f, entry);
}

std::vector<nlohmann::json> save_result_images(const std::filesystem::path& out, const ResultRow& row,
                                               const std::string& suffix, const PoseTruth& truth,
                                               const CompositedImages& images, float exposure_ev) {
    const std::string name =
        file_name(row.variant + "." + row.point, 150) + ".s" + std::to_string(row.seed) + "." + suffix;
    const nlohmann::json base = {{"shot", row.shot},
                                 {"frame", std::stoul(row.frame)},
                                 {"variant", row.variant},
                                 {"point", row.point},
                                 {"seed", row.seed}};
    std::vector<nlohmann::json> entries;
    const auto save = [&](const char* kind, const char* target, const HostImage& rgb, float ev) {
        nlohmann::json entry = base;
        entry["kind"] = kind, entry["target"] = target;
        entries.push_back(save_image(out, row.shot, name + "." + kind + "." + target, rgb, ev, entry));
    };
    const HostImage image = composited_image(truth, images);
    save("result", "image", image, exposure_ev);
    save("result", "specular", images.specular, exposure_ev);
    save("result", "incident", images.incident, exposure_ev);
    save("raw", "radiance", images.radiance, exposure_ev);
    save("confidence", "confidence", repeated_channel(images.confidence), 0.0f);
    for (const auto& [target, reference] : truth.targets) {
        const HostImage error = relative_error(tested_image(target, images, image), reference.image);
        nlohmann::json entry = base;
        entry["kind"] = "error", entry["target"] = target, entry["epsilon"] = relative_error_epsilon(reference.image);
        entries.push_back(save_image(out, row.shot, name + ".error." + target, error, PixelType::float32,
                                     error_picture(error), 0.0f, entry));
    }
    return entries;
}
