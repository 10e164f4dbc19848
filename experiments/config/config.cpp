#include "experiments/config/config.h"

#include "core/error.h"
#include "core/json.h"
#include "experiments/config/comparisons.h"
#include "experiments/config/config_parts.h"
#include "experiments/config/config_values.h"
#include "experiments/config/extends.h"
#include "experiments/config/primary_comparisons.h"
#include "experiments/config/read_shots.h"
#include "experiments/config/read_variants.h"
#include "metrics/masks.h"
#include "metrics/metric.h"

#include <algorithm>

namespace {

/// Of the masks that are asked for, those that tell one frame from another.
std::vector<std::string> default_frame_masks(const std::vector<std::string>& masks) {
    std::vector<std::string> chosen;
    for (const std::string& mask : masks)
        if (mask == "all" || mask == "reflective" || mask == "disoccluded") chosen.push_back(mask);
    return chosen.empty() ? masks : chosen;
}

ReferenceSettings read_reference(JsonObject object) {
    ReferenceSettings settings;
    if (object.has("samples")) settings.max_samples = unsigned(object.integer("samples", 16, 1 << 24));
    settings.max_seconds = object.number("seconds", 0.0f, 1e7f, 0.0f);
    settings.target_relative_error = object.number("target_relative_error", 0.0f, 1.0f, 0.0f);
    settings.max_depth = unsigned(object.integer("max_depth", 1, 1024, int(settings.max_depth)));
    settings.seed = unsigned(object.integer("seed", 0, 1 << 30, int(settings.seed)));
    object.finish();
    return settings;
}

}  // namespace

std::string display_name(const Config& config, const std::string& variant, const std::string& point) {
    for (const VariantConfig& v : config.variants)
        if (v.variant == variant && v.point == point && !v.label.empty()) return v.label;
    return point == "default" ? variant : variant + " " + point;
}

Config read_config(const std::filesystem::path& file) {
    Config config;
    config.file = file;
    const JsonDocument document = read_extended(file);
    config.source = document.value;
    JsonObject object(document, file.string());
    config.title = object.text("title", file.stem().string());
    if (object.has("$schema")) object.text("$schema");

    config.shots = read_shots(object, file.parent_path());
    config.variants = read_variants(object);
    config.has_reference = !(object.has("reference") && object.any("reference") == "none");
    if (object.has("reference") && config.has_reference) config.reference = read_reference(object.object("reference"));
    if (!config.has_reference && !std::ranges::all_of(config.shots, &ShotConfig::direct_lit))
        fail(object.at("reference"),
             ": 'reference' = \"none\" leaves no path-traced light to read; add \"lit\": \"direct\"");

    config.composite = object.value_of<CompositeFormula>(
        "composite",
        {{"split_sum", CompositeFormula::split_sum}, {"additive_fresnel", CompositeFormula::additive_fresnel}});
    if (object.has("timing")) {
        JsonObject timing = object.object("timing");
        config.timing.frames = unsigned(timing.integer("frames", 0, 100000, int(config.timing.frames)));
        config.timing.warm_up = unsigned(timing.integer("warm_up", 1, 1000, int(config.timing.warm_up)));
        config.timing.most_share = timing.number("most_share", 0, 1e6f, config.timing.most_share);
        config.timing.has_copies = timing.boolean("copies", config.timing.has_copies);
        timing.finish();
        if (config.timing.frames > 0 && config.timing.frames < 15)
            fail(timing.at("frames"), ": 'frames' = ", config.timing.frames,
                 " is too few for a median with an interval; allowed are 0 (no timing) or at least 15");
    }
    if (object.has("hits")) {
        JsonObject hits = object.object("hits");
        config.hits = JudgedRays{};
        config.hits->every = unsigned(hits.integer("every", 1, 64, int(config.hits->every)));
        config.hits->seeds = unsigned(hits.integer("seeds", 1, 1000000, int(config.hits->seeds)));
        hits.finish();
    }
    config.counts_costs = object.boolean("costs", false);
    config.keeps_all_images = object.choice("images", {"last", "all"}, "last") == "all";
    config.metrics = known_names(object, "metrics", metric_names(),
                                 {"mse", "relmse", "smape", "bias", "energy_ratio", "flip", "ssim"});
    config.masks = one_or_more(object, "masks", "");
    if (!object.has("masks")) config.masks = mask_names();
    for (const std::string& mask : config.masks) try {
            check_mask_name(mask);
        } catch (const Error& e) {
            fail(object.at("masks"), ": 'masks': ", e.what());
        }
    // Added reflections are no mean of incident radiance.
    const bool has_incident = config.composite == CompositeFormula::split_sum;
    const std::vector<std::string> shown_targets = {"specular", "image"};
    config.targets =
        known_names(object, "targets", has_incident ? target_names() : shown_targets,
                    has_incident ? std::vector<std::string>{"specular", "image", "incident"} : shown_targets);
    config.frame_metrics = known_names(object, "frame_metrics", metric_names(), {"mse", "relmse", "bias"}, true);
    config.frame_masks = known_names(object, "frame_masks", config.masks, default_frame_masks(config.masks));
    config.primary = read_primary(object, config);
    config.reflective_max_roughness =
        object.number("reflective_max_roughness", 0.0f, 1.0f, config.reflective_max_roughness);
    config.reflective_min_reflectance =
        object.number("reflective_min_reflectance", 0.0f, 1.0f, config.reflective_min_reflectance);
    check_tables(object, config);
    check_tune(object, config);
    object.finish();

    if (config.shots.empty()) fail(file.string(), ": 'shots' is missing or empty: name at least one scene");
    if (config.variants.empty())
        fail(file.string(), ": 'variants' is missing or empty: name at least one variant, e.g. \"none\"");
    find_against_points(config.variants, file.string());
    return config;
}
