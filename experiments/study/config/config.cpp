#include "experiments/study/config/config.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/config/config_parts.h"
#include "experiments/study/config/extends.h"
#include "experiments/study/config/points/read_techniques.h"
#include "experiments/study/config/shots/read_shots.h"
#include "metrics/direction.h"
#include "metrics/masks.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

constexpr unsigned least_timed_frames = 15;  // for a median with an interval

Values names_of_masks() {
    const Values roughness = {{{"type", "string"}, {"pattern", roughness_class_pattern}}, "", {}};
    return some_of(
        named(either(one_of(mask_names()), roughness),
              one_of(mask_names()).text + ", or a class of perceptual roughness such as `roughness_0.1_0.2`"));
}

Keys reference_keys() {
    const ReferenceSettings plain;
    return {{"samples", whole(16, 1 << 24),
             otherwise(std::to_string(ReferenceSettings::default_samples) +
                       "; no limit if `seconds` or `target_relative_error` is set"),
             "Largest number of samples per pixel, rounded up to 16 x 2^k"},
            {"adaptive_share", number(0, ReferenceSettings::most_adaptive_share), plain.adaptive_share,
             "Further specular directions of each sample, on average over the image, in frames that are compared with "
             "the truth. The pixels whose noise decides the interval of `mse` get them. 0.25 is a good value; not with "
             "`target_relative_error`"},
            {"adaptive_image", flag(), plain.adaptive_image,
             "`true`: the further directions are diffuse, too, and lower the noise of `image` relative to its "
             "brightness, in place of the noise of `mse`"},
            {"lit_samples", whole(16, 1 << 24),
             otherwise("`samples`; at most " + std::to_string(ReferenceSettings::default_samples) +
                       " for frames without other samples and with `target_relative_error`"),
             "Largest number of samples per pixel of the lit colour, which techniques read. The other samples add "
             "specular light only. Frames that are not compared with the truth need no other samples"},
            {"lit_noise", flag(), true,
             "`false` does not measure what the noise of the lit colour adds to errors. It saves two renderings of "
             "each point, but the intervals of errors then lack that noise"},
            {"lit_filter", flag(), false,
             "`true` removes most noise from the lit colour that techniques read (non-local means), so that few "
             "`lit_samples` are enough. The truth and captures are not filtered"},
            {"guide_samples", whole(16, 4096), plain.guide_samples,
             "Samples per pixel of the guide, rounded up to 16 x 2^k. The guide weighs relative errors and steers "
             "Russian roulette; 16 are enough if only `mse` is measured"},
            {"seconds", number(0, 1e7), Default(0, "no limit"),
             "Time limit in seconds for each frame, not counting the guide"},
            {"target_relative_error", number(0, 1), Default(0, "none"),
             "Relative standard error of the specular light at a pixel at which rendering stops"},
            {"max_depth", whole(1, 1024), plain.max_depth,
             "Largest number of reflections of a path; the camera ray does not count"},
            {"seed", whole(0, 1 << 30), plain.seed, "Seed of the path tracer"}};
}

Keys timing_keys() {
    const TimingConfig plain;
    return {{"frames", whole(0, 100000), plain.frames,
             "Timed frames of each point after the warm-up: at least 15, or 0 to take no times"},
            {"warm_up", whole(1, 1000), plain.warm_up, "Frames before the timed frames"},
            {"most_share", number(0, 1e6), Default(plain.most_share, "a third"),
             "Time limit for timing, as a share of the time that the shot's references, renders and counts took"},
            {"copies", flag(), plain.has_copies,
             "`false` times one copy of each point instead of two. This takes a third to a half of the time, but "
             "neither the noise of times nor the time saved by skipped work is then known"}};
}

Keys hits_keys() {
    const JudgedRays plain;
    return {{"every", whole(1, 64), plain.every, "Judge one pixel in this many along each axis"},
            {"seeds", whole(1, 1000000), Default(plain.seeds, "all"), "Judge at most this many seeds of each point"}};
}

Keys primary_keys() {
    const std::string or_first = ", or else the first that the study measures";
    const PrimaryComparisons plain;
    return {{"metric", any_text(), otherwise("`" + plain.metric + "`" + or_first), "Metric, for which less is better"},
            {"mask", any_text(), otherwise("`" + plain.mask + "`" + or_first), "One of `masks`"},
            {"target", one_of(target_names()), otherwise("`" + plain.target + "`" + or_first), "One of `targets`"},
            {"margin", number(0.001, 1), plain.margin,
             "Margin of equivalence: two errors are equivalent if they certainly differ by a smaller share. It holds "
             "for all errors"}};
}

/// `technique`: the schema of an entry of `techniques`.
Keys study_keys(const json& technique = json::object()) {
    const Config plain;
    const Keys keys = {
        {"$schema", any_text(), none, "Names a JSON Schema for editors; ignored"},
        {"extends", any_text(), none, "Path of another config, relative to this one, which this config changes"},
        {"title", any_text(), otherwise("the file's name"), "Title of the report"},
        {"shots", list_of_shots(), otherwise("required, or extended"), "Shots that are rendered"},
        {"techniques", named(checked_inside(array_of({technique, "", {}}), "array"), "an array of techniques"),
         otherwise("required, or extended"), "Techniques that are compared"},
        {"seeds", seeds(), otherwise(std::to_string(default_seeds) + " where a point depends on its seed, else 1"),
         "Seeds of random numbers; each is a separate run. Points without random numbers get only the first seed. A "
         "single seed gives no interval and no rank to points with random numbers"},
        {"primary", object_of(primary_keys()), otherwise("as below"),
         "The main error of the study. Reports and figures show it first. Its effects, over all points and shots, are "
         "adjusted together; effects on other errors are exploratory"},
        {"reference", named(either(object_of(reference_keys()), one_of({"none"})), "an object, or `none`"),
         otherwise("as below"),
         "Limits of the path tracer, which stops at the first one that it reaches. A limit of 0 counts as none. "
         "`none`, together with `\"lit\": \"direct\"`, renders no truth: no error is measured, but frames are timed "
         "and rays judged"},
        {"composite", one_of({"split_sum", "additive_fresnel"}), "split_sum",
         "How reflections enter the image. `split_sum`: (F0 A + F90 B) mix(fallback, radiance, confidence). "
         "`additive_fresnel`: added to an image that already contains reflections of the environment, as in some "
         "engines; the targets are then `specular` and `image`"},
        {"hits", object_of(hits_keys()), none,
         "Judge the rays of every measured frame by what they truly meet (`hits.csv` and maps). `{}` judges all pixels "
         "and seeds. The rays are traced once more for this, outside of timed frames"},
        {"costs", flag(), plain.counts_costs,
         "Count what each stage does in the last frame of a shot: invocations, fetches, bytes and operations "
         "(`costs.csv`). Each point then runs once more, with one seed"},
        {"gpu_compilers", named(array_of(any_text(), 0), "an array of texts"), json::array(),
         "GPUs for which each point's passes are compiled (`compiled.csv`: registers, occupancy, instructions). The "
         "GPU itself is not needed. `ssrlab list chips` names the GPUs, for example `navi21`"},
        {"images", one_of({"last", "all", "played", "none"}), "last",
         "Frames whose results, references, confidences and verdicts are stored as images. `last`: the last frame. "
         "`all`: every measured frame. `played`: the last frame, and only the reflections of earlier frames. `none`: "
         "no images"},
        {"timing", object_of(timing_keys()), otherwise("as below"), "How times are measured"},
        {"metrics", names_of_metrics(), Names{"mse", "relmse", "smape", "bias", "energy_ratio", "flip", "ssim"},
         "Metrics that are measured"},
        {"masks", names_of_masks(), mask_names(), "Masks: the sets of pixels over which metrics are computed"},
        {"frame_metrics",
         named(either(names_of_metrics(), {{{"type", "array"}, {"maxItems", 0}}, "", {}}),
               names_of_metrics().text + "; an empty array: nothing"),
         Names{"mse", "relmse", "bias"},
         "Metrics that are measured in every frame of a sequence, for the target `specular`. The last frame is "
         "measured in full"},
        {"frame_masks", names_of_masks(),
         otherwise("those of `all`, `reflective` and `disoccluded` in `masks`; if none, all `masks`"),
         "Masks for `frame_metrics`, each one of `masks`"},
        {"targets", some_of(one_of(target_names())), Names{"specular", "image", "incident"},
         "What is compared with the truth. `camera_radiance` and `on_screen` are rungs of the truth ladder"},
        {"reflective_max_roughness", number(0, 1), json_number(plain.reflective_max_roughness),
         "Largest perceptual roughness in the mask `reflective`"},
        {"reflective_min_reflectance", number(0, 1), json_number(plain.reflective_min_reflectance),
         "Smallest reflectance in the mask `reflective`: F0 A + F90 B, in the largest channel"},
        {"tables", named(checked_inside(array_of(object_of(table_keys()), 0), "array"), "an array of tables"), none,
         "Tables that `ssrlab tables` makes of the results"},
        {"frozen", named(checked_inside(array_of(object_of(frozen_keys()), 0), "array"), "an array of frozen points"),
         none,
         "Points that stand for their techniques at a given cost, chosen by another study on other scenes. Without "
         "this key, `ssrlab tradeoff` chooses for each scene the point with the least error in the other scenes"},
        {"tune", checked_inside({schema_of(tune_keys()), "an object", {}}, "object"), none,
         "What `ssrlab tune` varies. `ssrlab run` refuses such a study"}};
    return joined(keys, settings_of_shots());
}

/// Of the masks that are asked for, those that differ between frames.
Names default_frame_masks(const Names& masks) {
    Names chosen;
    for (const std::string& mask : masks)
        if (mask == "all" || mask == "reflective" || mask == "disoccluded") chosen.push_back(mask);
    return chosen.empty() ? masks : chosen;
}

void read_reference(ConfigObject& study, Config& config) {
    if (!study.has("reference")) return;
    config.has_reference = study["reference"] != "none";
    if (!config.has_reference) {
        if (std::ranges::all_of(config.shots, &ShotConfig::direct_lit)) return;
        fail(study.at("reference"),
             ": 'reference' = \"none\" leaves no path-traced light to read; add \"lit\": \"direct\"");
    }
    ConfigObject object = study.object("reference");
    ReferenceSettings& settings = config.reference;
    if (object.has("samples")) settings.max_samples = object.get<unsigned>("samples");
    if (object.has("lit_samples")) settings.lit_samples = object.get<unsigned>("lit_samples");
    settings.adaptive_share = object.get<float>("adaptive_share");
    settings.adaptive_image = object.get<bool>("adaptive_image");
    config.measures_lit_noise = object.get<bool>("lit_noise");
    config.filters_lit = object.get<bool>("lit_filter");
    settings.guide_samples = object.get<unsigned>("guide_samples");
    settings.max_seconds = object.get<float>("seconds");
    settings.target_relative_error = object.get<float>("target_relative_error");
    if (settings.adaptive_share > 0 && settings.target_relative_error > 0)
        fail(object.at("adaptive_share"),
             ": 'adaptive_share' and 'target_relative_error' both choose the noisy pixels; leave out one");
    if (settings.adaptive_image && settings.adaptive_share == 0)
        fail(object.at("adaptive_image"),
             ": 'adaptive_image' says what 'adaptive_share' is for; set that, for example 1");
    settings.max_depth = object.get<unsigned>("max_depth");
    settings.seed = object.get<unsigned>("seed");
    object.finish();
}

/// What a study with reflection probes cannot have: the truth ladder and rasterised direct light know the scene's
/// environment alone, and a capture brings its own.
void check_probes(ConfigObject& study, const Config& config) {
    const auto refuse_shots = [&](const auto& is_wrong, const char* why) {
        if (std::ranges::any_of(config.shots, [&](const ShotConfig& s) { return s.has_probe && is_wrong(s); }))
            fail(study.at("shots"), ": a shot with \"fallback\": \"probe\" ", why);
    };
    refuse_shots([](const ShotConfig& s) { return s.direct_lit; }, "needs path-traced light, not \"lit\": \"direct\"");
    refuse_shots([](const ShotConfig& s) { return !s.gbuffer.empty(); },
                 "needs a scene: a G-buffer from files brings its own fallback");
    if (std::ranges::any_of(config.shots, &ShotConfig::has_probe) &&
        std::ranges::find(config.targets, "on_screen") != config.targets.end())
        fail(study.at("targets"),
             ": the target 'on_screen' needs shots that fall back to the environment; remove it, or \"fallback\": "
             "\"probe\" of the shots");
}

void read_timing(ConfigObject timing, TimingConfig& config) {
    config.frames = timing.get<unsigned>("frames");
    config.warm_up = timing.get<unsigned>("warm_up");
    config.most_share = timing.get<float>("most_share");
    config.has_copies = timing.get<bool>("copies");
    timing.finish();
    if (config.frames > 0 && config.frames < least_timed_frames)
        fail(timing.at("frames"), ": 'frames' = ", config.frames,
             " is too few for a median with an interval; allowed are 0 (no timing) or at least ", least_timed_frames);
}

Names errors_in(const Names& metrics) {
    Names errors;
    std::ranges::copy_if(metrics, std::back_inserter(errors), is_error);
    return errors;
}

/// mse, reflective and specular as far as the study measures them, or else the first that it does, unless it says
/// otherwise. It may name any error that it measures in some shot: of its metrics, of single frames, and of sequences.
void read_primary(ConfigObject& study, Config& config) {
    const auto wanted_or_first = [](std::string& wanted, const Names& measured) {
        if (!measured.empty() && std::ranges::count(measured, wanted) == 0) wanted = measured.front();
    };
    Names errors = errors_in(config.metrics);
    PrimaryComparisons& primary = config.primary;
    wanted_or_first(primary.metric, errors);
    wanted_or_first(primary.mask, config.masks);
    wanted_or_first(primary.target, config.targets);
    if (!study.has("primary")) return;
    ConfigObject object = study.object("primary");
    std::ranges::copy(errors_in(config.frame_metrics), std::back_inserter(errors));
    for (const TemporalMetric& metric : temporal_metrics())
        if (is_error(metric.name)) errors.push_back(metric.name);
    if (object.has("metric")) primary.metric = object.known_texts("metric", errors).front();
    if (object.has("mask")) primary.mask = object.known_texts("mask", config.masks).front();
    if (object.has("target")) primary.target = object.known_texts("target", config.targets).front();
    if (object.has("margin")) primary.margin = object.get<double>("margin");
    object.finish();
}

/// What is measured: metrics, masks, targets.
void read_measures(ConfigObject& study, Config& config) {
    config.metrics = study.texts("metrics");
    config.masks = study.texts("masks");
    for (const std::string& mask : config.masks) try {
            check_mask_name(mask);  // the order of a class's edges, which no pattern can check
        } catch (const Error& e) {
            fail(study.at("masks"), ": 'masks': ", e.what());
        }
    config.targets = study.texts("targets");
    if (config.composite == CompositeFormula::additive_fresnel) {  // added reflections are no mean of incident radiance
        const Names shown = {"specular", "image"};
        config.targets = study.has("targets") ? study.known_texts("targets", shown) : shown;
    }
    config.frame_metrics = study.texts("frame_metrics");
    config.frame_masks =
        study.has("frame_masks") ? study.known_texts("frame_masks", config.masks) : default_frame_masks(config.masks);
    read_primary(study, config);
    config.reflective_max_roughness = study.get<float>("reflective_max_roughness");
    config.reflective_min_reflectance = study.get<float>("reflective_min_reflectance");
}

json technique_schema(const TechniqueEntry& entry) {
    json schema = schema_of(technique_keys(*make_technique(entry.name)));
    const std::string limits = limits_text(entry.limits);
    schema["properties"]["technique"] = {{"const", entry.name},
                                         {"description", entry.title + " (" + entry.source + ")" +
                                                             (limits.empty() ? "" : "; enforced limits: " + limits)}};
    Names presets = names_of(entry.presets, &Preset::name);
    presets.insert(presets.begin(), "");
    schema["properties"]["preset"].update(some_of(one_of(presets)).schema);
    return schema;
}

}  // namespace

std::string display_name(const Config& config, const std::string& technique, const std::string& point) {
    for (const PointConfig& v : config.techniques)
        if (v.technique == technique && v.point == point && !v.label.empty()) return v.label;
    return point_text({technique, point});
}

Config read_config(const std::filesystem::path& file) {
    Config config;
    config.file = file;
    const JsonDocument document = read_extended(file);
    config.source = document.value;
    ConfigObject study(JsonObject(document, file.string()), study_keys());
    study.has("$schema");
    config.title = study.has("title") ? study.get<std::string>("title") : file.stem().string();
    config.shots = read_shots(study, study, file.parent_path());
    config.techniques = read_techniques(study, file.parent_path());
    read_reference(study, config);
    if (study["composite"] == "additive_fresnel") config.composite = CompositeFormula::additive_fresnel;
    if (study.has("timing")) read_timing(study.object("timing"), config.timing);
    if (study.has("hits")) {
        ConfigObject hits = study.object("hits");
        config.hits = JudgedRays{.every = hits.get<unsigned>("every"), .seeds = hits.get<unsigned>("seeds")};
        hits.finish();
    }
    config.counts_costs = study.get<bool>("costs");
    config.gpu_compilers = study.get<std::vector<std::string>>("gpu_compilers");
    for (auto at = config.gpu_compilers.begin(); at != config.gpu_compilers.end(); ++at)
        if (std::count(config.gpu_compilers.begin(), at, *at) > 0)
            fail(study.at("gpu_compilers"), ": '", shortened(*at), "' is named twice; remove one of both");
    config.kept_images = study["images"] == "all"      ? KeptImages::measured
                         : study["images"] == "played" ? KeptImages::played
                         : study["images"] == "none"   ? KeptImages::none
                                                       : KeptImages::last;
    read_measures(study, config);
    check_probes(study, config);
    check_tables(study, config);
    check_frozen(study, config);
    check_tune(study, config);
    for (const Key& key : settings_of_shots()) study.has(key.name);  // read with the shots, of which there may be none
    study.finish();

    if (config.shots.empty()) fail(file.string(), ": 'shots' is missing or empty: name at least one scene");
    if (config.techniques.empty())
        fail(file.string(), ": 'techniques' is missing or empty: name at least one technique, for example \"none\"");
    find_against_points(config.techniques, file.string());
    if (!config.has_reference &&
        std::ranges::any_of(config.techniques, [](const PointConfig& v) { return v.external != nullptr; }))
        fail(study.at("reference"), ": external images are compared with the truth; remove \"reference\": \"none\"");
    return config;
}

json config_schema(const std::string& technique) {
    if (!technique.empty()) find_technique(technique);
    json schema;
    if (technique.empty()) {
        json techniques = json::array();
        for (const TechniqueEntry& entry : technique_table()) techniques.push_back(technique_schema(entry));
        techniques.push_back(schema_of(external_keys()));
        techniques.push_back({{"type", "object"},  // a technique's own folder, whose parameters are not known here
                              {"required", {"technique"}},
                              {"properties", {{"technique", {{"type", "string"}, {"pattern", "/"}}}}}});
        schema = schema_of(study_keys({{"anyOf", techniques}}));
        schema["anyOf"] = {{{"required", {"shots", "techniques"}}}, {{"required", {"extends"}}}};
    } else {
        schema = make_technique(technique)->params.schema();
    }
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = technique.empty() ? "ssrlab study" : "Parameters of " + technique;
    return schema;
}

json key_descriptions() {
    return {{"study", described(study_keys())},
            {"scene", described(scene_keys())},
            {"capture", described(capture_keys())},
            {"shot", described(keys_of_all_shots())},
            {"technique", described(technique_keys(*make_technique("none")))},
            {"external", described(external_keys())},
            {"table", described(table_keys())},
            {"frozen", described(frozen_keys())},
            {"tune", described(tune_keys())}};
}
