#include "experiments/study/shots/result_images.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/path_inside.h"
#include "core/png.h"
#include "experiments/results/cells/file_name.h"
#include "experiments/results/cells/image_path.h"
#include "metrics/color_map.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <span>

namespace {

/// An image that is kept as EXR and PNG.
struct KeptImage {
    std::string name;  ///< of both files, without extension
    nlohmann::json entry;
    HostImage rgb;
    float exposure_ev = 0.0f;
    PixelType type = PixelType::half;  ///< which does: results are looked at, and measured in float32
    HostImage picture = {};            ///< what the PNG shows, if it is not `rgb`
};

/// Writes it; its entry names both files with the hashes of their bytes.
nlohmann::json save(const std::filesystem::path& out, const std::string& folder, const KeptImage& image) {
    const std::string stem = "images/" + file_name(folder) + "/" + image.name;
    const std::filesystem::path exr = image_path(out, stem + ".exr"), png = image_path(out, stem + ".png");
    write_exr(exr, image.rgb, image.type);
    write_png(png, image.picture.values.empty() ? image.rgb : image.picture, image.exposure_ev);
    nlohmann::json entry = image.entry;
    entry["exr"] = stem + ".exr", entry["exr_hash"] = file_hash(exr);
    entry["png"] = stem + ".png", entry["png_hash"] = file_hash(png);
    return entry;
}

/// All at once: packing them takes the time.
std::vector<nlohmann::json> save(const std::filesystem::path& out, const std::string& folder,
                                 const std::vector<KeptImage>& images) {
    std::vector<nlohmann::json> entries(images.size());
    tbb::parallel_for(size_t(0), images.size(), [&](size_t i) { entries[i] = save(out, folder, images[i]); });
    return entries;
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

/// Of the images of a point's run.
std::string name_of(const ResultRow& row, const std::string& suffix) {
    return file_name(row.technique + "." + row.point, 150) + ".s" + std::to_string(row.seed) + "." + suffix;
}

nlohmann::json entry_of(const ResultRow& row, const std::string& kind, const std::string& target) {
    return {{"shot", row.shot},
            {"frame", std::stoul(row.frame)},
            {"technique", row.technique},
            {"point", row.point},
            {"seed", row.seed},
            {"kind", kind},
            {"target", target}};
}

}  // namespace

HostImage relative_error(const HostImage& test, const HostImage& reference) {
    const double epsilon = relative_error_epsilon(reference);
    HostImage error(reference.extent, 3);
    for (size_t i = 0; i < error.values.size(); ++i) {
        const double r = reference.values[i], x = test.values[i];
        error.values[i] = float((x - r) / (std::abs(r) + epsilon));
    }
    return error;
}

CompositedImages download_results(PassList& pass_list, const GBuffer& gbuffer, const Reflections& reflections,
                                  const Composite& composite, const HostImage& reflectance) {
    const HostImage radiance = pass_list.download(reflections.radiance),
                    fallback = pass_list.download(gbuffer.fallback);
    CompositedImages images{
        .specular = channels_of(pass_list.download(composite.specular), 0, 3),
        .incident = HostImage(radiance.extent, 3),
        .confidence = channels_of(pass_list.download(reflections.confidence), reflections.confidence_channel, 1),
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
    std::vector<std::pair<const char*, const ReferenceOutput*>> outputs = {
        {"image", &reference.image}, {"specular", &reference.specular}, {"incident", &reference.incident}};
    if (!reference.ladder.is_empty()) {
        outputs.push_back({"camera_radiance", &reference.ladder.camera_radiance});
        outputs.push_back({"on_screen", &reference.ladder.on_screen});
    }
    std::vector<KeptImage> images;
    for (const auto& [target, output] : outputs)
        images.push_back({.name = "reference." + reference.hash.substr(0, 8) + "." + target,
                          .entry = {{"shot", shot},
                                    {"frame", frame},
                                    {"technique", "reference"},
                                    {"kind", "reference"},
                                    {"target", target}},
                          .rgb = output->mean,
                          .exposure_ev = exposure_ev});
    return save(out, shot, images);
}

nlohmann::json save_played_reference(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                     const Reference& reference, float exposure_ev) {
    return save(out, shot,
                KeptImage{.name = "reference." + reference.hash.substr(0, 8) + ".specular",
                          .entry = {{"shot", shot},
                                    {"frame", frame},
                                    {"technique", "reference"},
                                    {"kind", "played"},
                                    {"target", "specular"}},
                          .rgb = reference.specular.mean,
                          .exposure_ev = exposure_ev});
}

nlohmann::json save_played_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                 const HostImage& specular, float exposure_ev) {
    return save(out, row.shot,
                KeptImage{.name = name_of(row, suffix) + ".played.specular",
                          .entry = entry_of(row, "played", "specular"),
                          .rgb = specular,
                          .exposure_ev = exposure_ev});
}

nlohmann::json save_roughness_image(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                    const HostImage& roughness) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(roughness.values)));
    return save(out, shot,
                KeptImage{.name = "surface." + hash.hex().substr(0, 8) + ".roughness",
                          .entry = {{"shot", shot},
                                    {"frame", frame},
                                    {"technique", "reference"},
                                    {"kind", "surface"},
                                    {"target", "roughness"}},
                          .rgb = repeated_channel(roughness)});
}

nlohmann::json save_verdict_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                  const std::string& stage, const HostImage& map) {
    return save(out, row.shot,
                KeptImage{.name = name_of(row, suffix) + ".hits." + file_name(stage, 60),
                          .entry = entry_of(row, "hits", stage),
                          .rgb = map});
}

std::vector<nlohmann::json> save_result_images(const std::filesystem::path& out, const ResultRow& row,
                                               const std::string& suffix, const PoseTruth& truth,
                                               const CompositedImages& images, float exposure_ev) {
    std::vector<KeptImage> kept;
    const auto keep = [&](const std::string& kind, const std::string& target, const HostImage& rgb,
                          float ev) -> KeptImage& {
        return kept.emplace_back(KeptImage{.name = name_of(row, suffix) + "." + kind + "." + target,
                                           .entry = entry_of(row, kind, target),
                                           .rgb = rgb,
                                           .exposure_ev = ev});
    };
    const HostImage image = composited_image(truth, images);
    keep("result", "image", image, exposure_ev);
    keep("result", "specular", images.specular, exposure_ev);
    if (!images.incident.values.empty()) {
        keep("result", "incident", images.incident, exposure_ev);
        keep("raw", "radiance", images.radiance, exposure_ev);
        keep("confidence", "confidence", repeated_channel(images.confidence), 0.0f);
    }
    for (const auto& [target, reference] : truth.targets) {
        const HostImage& tested = tested_image(target, images, image);
        if (tested.values.empty()) continue;
        const HostImage error = relative_error(tested, reference.image);
        KeptImage& of_error = keep("error", target, error, 0.0f);
        of_error.entry["epsilon"] = relative_error_epsilon(reference.image);
        of_error.type = PixelType::float32, of_error.picture = error_picture(error);
    }
    return save(out, row.shot, kept);
}
