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
    return {
        {"samples", whole(16, 1 << 24),
         otherwise(std::to_string(ReferenceSettings::default_samples) +
                   "; no limit if `seconds` or `target_relative_error` is set"),
         "per pixel, rounded up to 16 x 2^k"},
        {"lit_samples", whole(16, 1 << 24),
         otherwise("`samples`; where nothing else is rendered and `target_relative_error` is set " +
                   std::to_string(ReferenceSettings::default_samples) + " at most"),
         "the same of the lit colour alone, which techniques read: the rest of `samples` is of the specular light. "
         "In frames that no result is compared with nothing else is rendered"},
        {"lit_noise", flag(), true,
         "false leaves out the two further plays of each point that measure what the noise of the lit colour adds "
         "to its error, two thirds of the rendering with one seed: the error's interval then lacks it"},
        {"lit_filter", flag(), false,
         "true gives techniques the lit colour without most of its noise, as an engine has it: non-local means of the "
         "light on the surfaces, so that few `lit_samples` serve. What is compared with the truth is not filtered, nor "
         "are captures"},
        {"guide_samples", whole(16, 4096), plain.guide_samples,
         "per pixel of the guide, which weighs relative errors and tells roulette what to expect, rounded up to "
         "16 x 2^k: 16 serve where `mse` alone is judged"},
        {"seconds", number(0, 1e7), Default(0, "no limit"), "for each frame, beside those of its guide"},
        {"target_relative_error", number(0, 1), Default(0, "none"),
         "the relative standard error of the specular light at a pixel"},
        {"max_depth", whole(1, 1024), plain.max_depth, "reflections of a path, the camera ray not counted"},
        {"seed", whole(0, 1 << 30), plain.seed, "the reference's own"}};
}

Keys timing_keys() {
    const TimingConfig plain;
    return {{"frames", whole(0, 100000), plain.frames,
             "measured for each point, after the warm-up: at least 15, or 0 for none"},
            {"warm_up", whole(1, 1000), plain.warm_up, "frames before them"},
            {"most_share", number(0, 1e6), Default(plain.most_share, "a third"),
             "what they may take in all, as a share of the time that the shot's references, renders and counts took: "
             "see \"What "
             "the numbers mean\""},
            {"copies", flag(), plain.has_copies,
             "false times each point alone, in a third of the time, or half where no work can be skipped: the noise "
             "of times is then unknown, and so is what skipped work saves"}};
}

Keys hits_keys() {
    const JudgedRays plain;
    return {{"every", whole(1, 64), plain.every, "one pixel in so many along each axis"},
            {"seeds", whole(1, 1000000), Default(plain.seeds, "all"), "the first of a point's seeds, at most"}};
}

Keys primary_keys() {
    const std::string or_first = ", or else the first that the study measures";
    const PrimaryComparisons plain;
    return {{"metric", any_text(), otherwise("`" + plain.metric + "`" + or_first), "of which less is better"},
            {"mask", any_text(), otherwise("`" + plain.mask + "`" + or_first), "one of `masks`"},
            {"target", one_of(target_names()), otherwise("`" + plain.target + "`" + or_first), "one of `targets`"},
            {"margin", number(0.001, 1), plain.margin,
             "two errors, whichever the study measures, are equivalent where it is certain that they differ by a "
             "smaller share than this"}};
}

/// `technique`: the schema of an entry of `techniques`.
Keys study_keys(const json& technique = json::object()) {
    const Config plain;
    const Keys keys = {
        {"$schema", any_text(), none, "for editors"},
        {"extends", any_text(), none,
         "another config, by its path from this one's folder, which this one patches, below"},
        {"title", any_text(), otherwise("the file's name"), "heads the report"},
        {"shots", list_of_shots(), otherwise("required, or extended"), "what is looked at"},
        {"techniques", named(checked_inside(array_of({technique, "", {}}), "array"), "an array of techniques, below"),
         otherwise("required, or extended"), "what is compared"},
        {"seeds", seeds(), otherwise(std::to_string(default_seeds) + " where a point depends on its seed, else 1"),
         "each is a run of its own. Points that draw no random numbers get the first of them only; a single seed of "
         "one that does has no interval and is not ranked"},
        {"primary", object_of(primary_keys()), otherwise("as below"),
         "the error that the study is made to compare. Its effects, over all points and shots, are adjusted together; "
         "all others are exploratory. Report and figures show it first"},
        {"reference", named(either(object_of(reference_keys()), one_of({"none"})), "an object, or `none`"),
         otherwise("as below"),
         "when the path tracer stops: at whichever of its limits comes first, and what is not set or 0 does not stop "
         "it. `none`, with `\"lit\": \"direct\"`: no error is measured, frames are timed and rays judged"},
        {"composite", one_of({"split_sum", "additive_fresnel"}), "split_sum",
         "`split_sum`: (F0 A + F90 B) mix(fallback, radiance, confidence). `additive_fresnel`: as an engine adds "
         "reflections to an image that holds those of its environment already (variants/four_mode_ssr); targets are "
         "`specular` and `image` then"},
        {"hits", object_of(hits_keys()), none,
         "judges the rays of every measured frame by what they truly meet (`hits.csv`, maps); `{}` judges all. They "
         "are traced a second time for it; times are not touched"},
        {"costs", flag(), plain.counts_costs,
         "counts what each stage of each point does in a shot's last frame (`costs.csv`): invocations, fetches, bytes, "
         "operations, without a clock. Costs each point another run of one seed, and the compilation of its shaders"},
        {"gpu_compilers", array_of(any_text(), 0), json::array(),
         "GPUs whose compiler is asked what it makes of each point's passes (`compiled.csv`): registers, occupancy, "
         "instructions. No GPU is needed; `ssrlab list chips` names them, `navi21`, `gfx1100` and `vega10` among them"},
        {"images", one_of({"last", "all", "played", "none"}), "last",
         "of which frames results, references, confidence and verdicts are kept as images, which the report's viewer "
         "plays: the last, or `all` that are measured. `played`: the last, and of each frame before it the reflections "
         "alone (target `specular`), of the truth, too, where the frame has a reference. `none`: numbers alone, in "
         "less "
         "time and space"},
        {"timing", object_of(timing_keys()), otherwise("as below"), "how times are taken"},
        {"metrics", names_of_metrics(), Names{"mse", "relmse", "smape", "bias", "energy_ratio", "flip", "ssim"},
         "what is measured; which differences each sees: metrics/README.md, power"},
        {"masks", names_of_masks(), mask_names(), "over which pixels"},
        {"frame_metrics",
         named(either(names_of_metrics(), {{{"type", "array"}, {"maxItems", 0}}, "", {}}),
               names_of_metrics().text + "; an empty array: nothing"),
         Names{"mse", "relmse", "bias"},
         "in a shot of several frames, what is measured of each (target `specular`) besides the full measure of the "
         "last"},
        {"frame_masks", names_of_masks(), otherwise("of `masks` all, reflective and disoccluded, or else all"),
         "the masks of that, which must be among `masks`"},
        {"targets", some_of(one_of(target_names())), Names{"specular", "image", "incident"},
         "what is compared; `camera_radiance` and `on_screen` are rungs of the truth ladder, below"},
        {"reflective_max_roughness", number(0, 1), json_number(plain.reflective_max_roughness),
         "the mask `reflective`: perceptual roughness at most"},
        {"reflective_min_reflectance", number(0, 1), json_number(plain.reflective_min_reflectance),
         "the mask `reflective`: split-sum reflectance F0 A + F90 B (largest channel) at least"},
        {"tables", named(checked_inside(array_of(object_of(table_keys()), 0), "array"), "an array of tables, below"),
         none, "what `ssrlab tables` makes of the results, below"},
        {"frozen", named(checked_inside(array_of(object_of(frozen_keys()), 0), "array"), "an array, below"), none,
         "which point stands for a technique at a cost, chosen on other scenes by another study, before these are "
         "seen; "
         "without it each scene is judged by what errs least in the others"},
        {"tune", checked_inside({schema_of(tune_keys()), "an object, below", {}}, "object"), none,
         "what `ssrlab tune` varies, below; such a study is not run by itself"}};
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
    config.measures_lit_noise = object.get<bool>("lit_noise");
    config.filters_lit = object.get<bool>("lit_filter");
    settings.guide_samples = object.get<unsigned>("guide_samples");
    settings.max_seconds = object.get<float>("seconds");
    settings.target_relative_error = object.get<float>("target_relative_error");
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
             ": the target 'on_screen' falls back to the environment, the shots to a probe: leave out one of both");
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
            fail(study.at("gpu_compilers"), ": '", shortened(*at), "' stands there twice");
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
        fail(file.string(), ": 'techniques' is missing or empty: name at least one technique, e.g. \"none\"");
    find_against_points(config.techniques, file.string());
    if (!config.has_reference &&
        std::ranges::any_of(config.techniques, [](const PointConfig& v) { return v.external != nullptr; }))
        fail(study.at("reference"), ": \"reference\": \"none\" leaves nothing to judge external images by");
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

std::string with_key_tables(const std::string& markdown) {
    const std::vector<std::pair<std::string, Keys>> objects = {{"study", study_keys()},
                                                               {"scene", scene_keys()},
                                                               {"capture", capture_keys()},
                                                               {"shot", keys_of_all_shots()},
                                                               {"technique", technique_keys(*make_technique("none"))},
                                                               {"external", external_keys()},
                                                               {"table", table_keys()},
                                                               {"frozen", frozen_keys()},
                                                               {"tune", tune_keys()}};
    std::string text = markdown;
    for (const auto& [name, keys] : objects) {
        const std::string head = "<!-- keys of " + name + " -->\n", end = "<!-- end of keys -->";
        const size_t begin = text.find(head), stop = text.find(end, begin);
        if (begin == std::string::npos || stop == std::string::npos) fail("no line ", head, "followed by ", end);
        text.replace(begin + head.size(), stop - begin - head.size(), key_table(keys));
    }
    return text;
}
