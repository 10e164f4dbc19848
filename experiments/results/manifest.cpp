#include "experiments/results/manifest.h"

#include "core/exr.h"
#include "core/files.h"
#include "core/png.h"
#include "experiments/measuring/needs.h"
#include "experiments/results/file_name.h"
#include "experiments/study/cell_store.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/config/read_shots.h"
#include "groundtruth/reference_audit.h"
#include "groundtruth/reference_error.h"
#include "metrics/color_map.h"
#include "variants/registry.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

namespace {

nlohmann::json variant_entries(const Config& config) {
    nlohmann::json entries = nlohmann::json::array();
    const std::vector<SingleChange> changes = single_changes(config.variants);
    for (const VariantConfig& v : config.variants) {
        const VariantEntry& entry = find_variant(v.variant);
        const auto variant = make_variant(v.variant, v.parameters, v.preset);
        entries.push_back({{"variant", v.variant},
                           {"point", v.point},
                           {"title", entry.title},
                           {"source", entry.source},
                           {"parameters", variant->params.values()},
                           {"depends_on_seed", variant->depends_on_seed()}});
        if (!v.label.empty()) entries.back()["label"] = v.label;
        if (!v.group.empty()) entries.back()["group"] = v.group;
        if (!v.swept.empty()) entries.back()["swept"] = v.swept;
        if (variant->asks_scene()) entries.back()["asks_scene"] = true;
        if (v.is_baseline) entries.back()["baseline"] = true;
        for (const SingleChange& c : changes)
            if (c.variant == v.variant && c.point == v.point)
                entries.back()["single_change"] = {{"parameter", c.parameter}, {"value", c.value}};
        if (variant->limits != Limits::none) entries.back()["limits"] = name_of(variant->limits);
        if (const std::string why = variant->not_repeatable(); !why.empty()) entries.back()["not_repeatable"] = why;
    }
    return entries;
}

/// Within the source tree relative to it, as documents name it.
std::string shown_path(const std::filesystem::path& file) {
    const std::filesystem::path inside = std::filesystem::proximate(file, SSRLAB_SOURCE_DIR);
    return (inside.empty() || inside.begin()->string() == ".." ? file : inside).string();
}

/// What the parameters of the study's variants mean: {variant: {parameter: meaning}}.
nlohmann::json parameter_docs(const Config& config) {
    nlohmann::json docs = nlohmann::json::object();
    for (const VariantConfig& v : config.variants)
        for (const auto variant = make_variant(v.variant); const Parameter& p : variant->params)
            docs[v.variant][p.name] = p.doc;
    return docs;
}

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

/// What is said of facts and of what was left out.
nlohmann::json fact_entry(const SceneFact& fact) {
    return {{"fact", fact.name}, {"value", fact.value}, {"why", fact.why}};
}

nlohmann::json left_out_entry(const LeftOut& part) {
    return {{"what", full_name(part)},
            {"stage", part.stage.empty() ? part.what : part.stage},
            {"fact", part.fact},
            {"why", part.why},
            {"keeps_bits", part.keeps_bits},
            {"saved_ms", nullptr}};
}

/// What path tracer, rasteriser and variants leave out, each once.
nlohmann::json left_out_entries(const Shot& shot, const Config& config) {
    nlohmann::json entries = nlohmann::json::array();
    for (const auto& [who, part] : left_out_of(shot, config.variants)) {
        nlohmann::json entry = left_out_entry(part);
        const bool says_whose = part.what.find('/') != std::string::npos || !part.stage.empty();
        if (!says_whose) entry["what"] = who + ": " + part.what;
        if (std::ranges::find(entries, entry) == entries.end()) entries.push_back(entry);
    }
    return entries;
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

nlohmann::json study_entry(const Config& config) {
    nlohmann::json warnings = nlohmann::json::array();
    if (std::ranges::any_of(config.shots, &ShotConfig::direct_lit))
        warnings.push_back(
            "SSR read rasterised direct light, not the truth's lit colour: part of its error is that light's");
    if (config.composite == CompositeFormula::additive_fresnel)
        warnings.push_back(
            "reflections were added to an image that holds the environment's already, as an engine's document prints "
            "it: "
            "where both are found, both count");
    std::set<unsigned> bits;
    for (const ShotConfig& shot : config.shots) bits.insert(shot.normal_bits);
    for (const unsigned count : bits)
        if (count > 0)
            warnings.push_back("techniques and composite read normals of 2 x " + std::to_string(count) +
                               " bits; the truth has its own");
    return {{"study", {{"name", config.file.stem().string()}, {"config", shown_path(config.file)}}},
            {"title", config.title},
            {"config", config.source},
            {"clock", nlohmann::json::object()},
            {"warnings", warnings},
            {"shots", nlohmann::json::array()},
            {"variants", variant_entries(config)},
            {"primary",
             {{"metric", config.primary.metric}, {"mask", config.primary.mask}, {"target", config.primary.target}}},
            {"parameter_docs", parameter_docs(config)},
            {"images", nlohmann::json::array()}};
}

nlohmann::json shot_entry(const Shot& shot, const PixelFacts& pixels, const Config& config, bool keep_all) {
    nlohmann::json needs = nlohmann::json::array();
    if (shot.config.gbuffer.empty())
        for (const SceneFact& fact : list_facts(shot.scene, shot.facts)) needs.push_back(fact_entry(fact));
    for (const SceneFact& fact : list_facts(pixels)) needs.push_back(fact_entry(fact));
    nlohmann::json entry = {{"shot", shot.name()},
                            {"scene", shot.scene.name},
                            {"camera", shot.camera.name},
                            {"width", shot.config.extent.x},
                            {"height", shot.config.extent.y},
                            {"frame", shot.config.frames.back()},
                            {"frames", shot.config.frames},
                            {"warm_up", shot.config.warm_up},
                            {"repeat", shot.config.repeat},
                            {"measure", shot.config.measures_last_only ? "last" : "all"},
                            {"measure_from", std::max(shot.config.measure_from, shot.config.frames.front())},
                            {"exposure_ev", shot.camera.exposure_ev},
                            {"warnings", shot.scene.warnings},
                            {"needs", needs},
                            {"left_out", keep_all ? nlohmann::json::array() : left_out_entries(shot, config)}};
    if (shot.config.change) entry["change"] = *shot.config.change;
    if (!shot.config.label.empty()) entry["label"] = shot.config.label;
    if (!shot.config.group.empty()) entry["group"] = shot.config.group;
    entry.update(shot_settings(shot.config));
    return entry;
}

nlohmann::json reference_entry(const Reference& reference, unsigned frame, const Config& config) {
    std::vector<float> samples = reference.sample_count.values;
    std::ranges::nth_element(samples, samples.begin() + long(samples.size() / 2));
    const ErrorSummary error = relative_error_summary(reference, reference.specular);
    const ReferenceAudit audit = audit_reference(reference);
    nlohmann::json halves;
    for (const auto& [output, of_output] : audit.outputs)
        halves[output] = {{"mean_z_squared", of_output.mean_z_squared},
                          {"low", of_output.low},
                          {"high", of_output.high},
                          {"correlation", of_output.correlation},
                          {"most_correlation", of_output.most_correlation}};
    return {{"frame", frame},
            {"hash", reference.hash},
            {"samples_median", samples[samples.size() / 2]},
            {"passes", reference.passes},
            {"seconds", reference.seconds},
            {"rays", reference.rays},
            {"max_depth", config.reference.max_depth},
            {"target_relative_error", json_number(config.reference.target_relative_error)},
            {"relative_error", {{"median", error.median}, {"p95", error.p95}, {"mean", error.mean}}},
            {"reached_share", reference.reached_share},
            {"non_finite_samples", reference.non_finite_samples},
            {"halves", halves},
            {"light_cut", audit.light_cut},
            {"warnings", audit.warnings},
            {"from_cache", reference.from_cache}};
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
