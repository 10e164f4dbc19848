#include "experiments/study/config/config.h"

#include "core/error.h"
#include "core/json.h"
#include "core/near_miss.h"
#include "experiments/study/capture.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/config/config_parts.h"
#include "experiments/study/config/primary_comparisons.h"
#include "metrics/ghost.h"
#include "metrics/masks.h"
#include "metrics/metric.h"
#include "variants/registry.h"

#include <algorithm>
#include <numeric>

namespace {

constexpr int max_side = 16384;  // pixels; what Vulkan devices commonly allow for an image
constexpr unsigned max_frames = 100000, max_seed = 100000;

/// A text, or an array of texts.
std::vector<std::string> one_or_more(JsonObject& object, const std::string& key, const std::string& fallback) {
    if (!object.has(key)) return {fallback};
    const nlohmann::json& value = object.any(key);
    if (value.is_string()) return {value.get<std::string>()};
    const bool fits =
        value.is_array() && !value.empty() && std::ranges::all_of(value, [](const auto& v) { return v.is_string(); });
    if (!fits) fail(object.where(), ": '", key, "' must be a text or an array of texts, not ", shown(value));
    return value.get<std::vector<std::string>>();
}

std::vector<std::string> known_names(JsonObject& object, const std::string& key, const std::vector<std::string>& known,
                                     const std::vector<std::string>& fallback, bool may_be_empty = false) {
    if (!object.has(key)) return fallback;
    if (may_be_empty && object.any(key) == nlohmann::json::array()) return {};
    const std::vector<std::string> names = one_or_more(object, key, "");
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            fail(object.where(), ": '", key, "' names \"", name, "\", which is not known", suggestion(name, known));
    return names;
}

/// Of the masks that are asked for, those that tell one frame from another.
std::vector<std::string> default_frame_masks(const std::vector<std::string>& masks) {
    std::vector<std::string> chosen;
    for (const std::string& mask : masks)
        if (mask == "all" || mask == "reflective" || mask == "disoccluded") chosen.push_back(mask);
    return chosen.empty() ? masks : chosen;
}

/// A count n, which stands for 0 .. n-1, or an array of ascending whole numbers.
std::vector<unsigned> numbers(JsonObject& object, const std::string& key, unsigned max,
                              const std::vector<unsigned>& fallback) {
    if (!object.has(key)) return fallback;
    const nlohmann::json& value = object.any(key);
    std::vector<unsigned> list;
    if (!value.is_array()) {
        const int count = object.integer(key, 1, int(max));
        for (int i = 0; i < count; ++i) list.push_back(unsigned(i));
        return list;
    }
    for (const auto& v : value) {
        if (!v.is_number_integer() || v.get<long long>() < 0 || v.get<long long>() > max)
            fail(object.where(), ": '", key, "' holds ", shown(v), "; allowed are whole numbers in [0, ", max, "]");
        list.push_back(v.get<unsigned>());
    }
    const bool ascends = std::ranges::adjacent_find(list, std::greater_equal()) == list.end();
    if (list.empty() || !ascends)
        fail(object.where(), ": '", key, "' must hold at least one number, each greater than the one before");
    return list;
}

/// The seeds that a study or a variant names; none if it names none.
std::optional<std::vector<unsigned>> read_seeds(JsonObject& object) {
    if (!object.has("seeds")) return {};
    return numbers(object, "seeds", max_seed, {});
}

/// A variant's own are obeyed to the letter. Of those that a study names for all, a point that does not depend on them
/// needs one.
std::vector<unsigned> seeds_of(const std::optional<std::vector<unsigned>>& own,
                               const std::optional<std::vector<unsigned>>& of_study, bool depends_on_seed) {
    if (own) return *own;
    if (of_study) return depends_on_seed ? *of_study : std::vector{of_study->front()};
    std::vector<unsigned> seeds(depends_on_seed ? default_seeds : 1);
    std::iota(seeds.begin(), seeds.end(), 0u);
    return seeds;
}

glm::uvec2 read_extent(JsonObject& shot) {
    const nlohmann::json& value = shot.any("resolution");
    const bool fits =
        value.is_array() && value.size() == 2 && value[0].is_number_integer() && value[1].is_number_integer();
    if (!fits) fail(shot.where(), ": 'resolution' must be [width, height] in pixels, not ", shown(value));
    const long long width = value[0], height = value[1];
    if (width < 1 || height < 1 || width > max_side || height > max_side)
        fail(shot.where(), ": 'resolution' ", shown(value), " is outside [1, ", max_side, "] pixels");
    return {width, height};
}

/// A count, an array, or {"from", "to"}, both included; `all` where the shot names none.
std::vector<unsigned> read_frames(JsonObject& shot, const std::vector<unsigned>& all) {
    if (!shot.has("frames") || !shot.any("frames").is_object()) return numbers(shot, "frames", max_frames, all);
    JsonObject range = shot.object("frames");
    const int from = range.integer("from", 0, int(max_frames)), to = range.integer("to", from, int(max_frames));
    range.finish();
    std::vector<unsigned> frames;
    for (int frame = from; frame <= to; ++frame) frames.push_back(unsigned(frame));
    return frames;
}

/// How a shot is played; config.frames holds all that it has.
void read_timeline(JsonObject& shot, ShotConfig& config) {
    config.frames = read_frames(shot, config.frames);
    config.measure_from = unsigned(shot.integer("measure_from", int(config.frames.front()), int(config.frames.back()),
                                                int(config.frames.front())));
    config.warm_up = unsigned(shot.integer("warm_up", 0, int(max_frames), 0));
    config.repeat = unsigned(shot.integer("repeat", 1, int(max_frames), 1));
    config.measures_last_only = shot.choice("measure", {"all", "last"}, "all") == "last";
    if (!shot.has("change")) return;
    config.change = unsigned(shot.integer("change", 0, int(max_frames)));
    if (std::ranges::find(config.frames, *config.change) == config.frames.end() ||
        config.change == config.frames.front())
        fail(shot.where(), ": 'change' = ", *config.change, " must be one of 'frames' after the first of them, ",
             config.frames.front());
    const size_t after =
        size_t(std::ranges::count_if(config.frames, [&](unsigned frame) { return frame >= *config.change; })) +
        config.repeat - 1;
    if (after < least_ghost_frames)
        fail(shot.where(), ": 'change' = ", *config.change, " is followed by ", after, " frames; at least ",
             least_ghost_frames, " must show how it fades: add 'frames', or a 'repeat' of the last");
}

/// G-buffers from files; their paths are relative to the config's folder.
ShotConfig read_capture(JsonObject& shot, const std::filesystem::path& folder) {
    ShotConfig config{.gbuffer = folder / shot.text("gbuffer")};
    if (shot.has("reference")) config.reference = folder / shot.text("reference");
    config.frames = Capture(config.gbuffer).frames();
    read_timeline(shot, config);
    shot.finish();
    return config;
}

/// scene x camera; frames stay together, since a history runs through them.
void read_shot(JsonObject shot, const std::filesystem::path& folder, std::vector<ShotConfig>& shots) {
    if (shot.has("gbuffer")) return shots.push_back(read_capture(shot, folder));
    const std::vector<std::string> scenes = one_or_more(shot, "scene", ""), cameras = one_or_more(shot, "camera", "");
    if (!shot.has("scene")) shot.text("scene");  // says that it is missing
    ShotConfig config;
    if (shot.has("resolution")) config.extent = read_extent(shot);
    read_timeline(shot, config);
    shot.finish();
    for (const std::string& scene : scenes)
        for (const std::string& camera : cameras) {
            config.scene = scene, config.camera = camera;
            shots.push_back(config);
        }
}

void check_values(const std::string& key, const std::string& name, const nlohmann::json& values,
                  const std::string& where) {
    if (!values.is_array() || values.empty())
        fail(where, ": ", key, ": '", name, "' must be an array of values, not ", shown(values));
}

/// All combinations of the swept values, in the order of the axes as written, the last axis fastest.
std::vector<nlohmann::json> grid_points(const nlohmann::json& axes, const std::string& where) {
    std::vector<nlohmann::json> points = {nlohmann::json::object()};
    for (const auto& [name, values] : axes.items()) {
        check_values("sweep", name, values, where);
        std::vector<nlohmann::json> longer;
        for (const nlohmann::json& point : points)
            for (const nlohmann::json& value : values) {
                longer.push_back(point);
                longer.back()[name] = value;
            }
        points = std::move(longer);
    }
    return points;
}

/// The variant; fails with the place in the file if there is none such.
std::unique_ptr<Variant> make_checked(const JsonObject& entry, const std::string& name,
                                      const nlohmann::json& parameters = nlohmann::json::object(),
                                      const std::string& preset = "") {
    try {
        return make_variant(name, parameters, preset);
    } catch (const Error& e) {
        fail(entry.where(), ": ", e.what());
    }
}

/// One point for each value of each parameter, which differs in nothing else, in the order of the declarations.
std::vector<nlohmann::json> single_changes(nlohmann::json axes, const ParameterSet& declared,
                                           const std::string& where) {
    std::vector<nlohmann::json> points;
    const auto add = [&](const std::string& name) {
        check_values("each", name, axes[name], where);
        for (const nlohmann::json& value : axes[name]) points.push_back({{name, value}});
    };
    if (axes.empty()) fail(where, ": 'each' is empty; name parameters with the values to try");
    for (const Parameter& parameter : declared)
        if (axes.contains(parameter.name)) add(parameter.name), axes.erase(parameter.name);
    for (const auto& [name, values] : axes.items())
        points.push_back({{name, values}});  // unknown: refused by the variant
    return points;
}

std::vector<nlohmann::json> read_points(JsonObject& entry, const std::string& variant) {
    for (const char* key : {"sweep", "each"})
        if (entry.has(key) && !entry.any(key).is_object())
            fail(entry.where(), ": '", key, "' must be an object, not ", shown(entry.any(key)));
    if (entry.has("sweep") && entry.has("each"))
        fail(entry.where(), ": 'sweep' and 'each' exclude one another; write two entries");
    if (entry.has("each"))
        return single_changes(entry.any("each"), make_checked(entry, variant)->params, entry.where());
    return grid_points(entry.has("sweep") ? entry.any("sweep") : nlohmann::json::object(), entry.where());
}

nlohmann::json with_values(nlohmann::json parameters, const nlohmann::json& changed) {
    parameters.update(changed);
    return parameters;
}

void read_variant(JsonObject entry, const std::optional<std::vector<unsigned>>& study_seeds,
                  std::vector<VariantConfig>& variants) {
    const std::string name = entry.text("variant");
    make_checked(entry, name);
    const std::vector<std::string> presets = one_or_more(entry, "preset", "");
    const nlohmann::json parameters = entry.has("parameters") ? entry.any("parameters") : nlohmann::json::object();
    if (!parameters.is_object()) fail(entry.where(), ": 'parameters' must be an object, not ", shown(parameters));
    const std::vector<nlohmann::json> points = read_points(entry, name);
    const std::optional<std::vector<unsigned>> own_seeds = read_seeds(entry);
    const nlohmann::json against = entry.has("against") ? entry.any("against") : nlohmann::json();
    if (entry.has("against") && (!against.is_object() || against.empty()))
        fail(entry.where(), ": 'against' must be an object of parameter values, not ", shown(against));
    const bool is_baseline = entry.boolean("baseline", false), is_timed = entry.boolean("timing", true);
    entry.finish();
    for (const std::string& preset : presets)
        for (const nlohmann::json& point : points) {
            VariantConfig variant{.variant = name,
                                  .preset = preset,
                                  .parameters = parameters,
                                  .swept = point,
                                  .point = preset,
                                  .seeds = {},
                                  .is_baseline = is_baseline,
                                  .against = against,
                                  .is_timed = is_timed};
            variant.parameters.update(point);
            if (!point.empty()) variant.point += (preset.empty() ? "" : " ") + label_of(point);
            if (variant.point.empty()) variant.point = "default";
            const auto made = make_checked(entry, name, variant.parameters, preset);
            variant.depends_on_seed = made->depends_on_seed();
            variant.is_timed = is_timed && !made->asks_scene();
            variant.seeds = seeds_of(own_seeds, study_seeds, variant.depends_on_seed);
            if (!against.is_null()) make_checked(entry, name, with_values(variant.parameters, against), preset);
            variants.push_back(std::move(variant));
        }
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

/// A shot that comes twice would do the same work under the same name.
void refuse_repeated_shots(const std::vector<ShotConfig>& shots, const std::string& where) {
    for (size_t i = 0; i < shots.size(); ++i)
        for (size_t j = i + 1; j < shots.size(); ++j)
            if (shots[i] == shots[j])
                fail(where, ": shots: '", shots[i].scene.empty() ? shots[i].gbuffer.string() : shots[i].scene,
                     "' comes twice with the same camera, resolution and frames; leave one of them out");
}

/// The pairs (variant, point) name cells and rows, so they must differ.
void refuse_repetition(const std::vector<VariantConfig>& variants, const std::string& where) {
    for (size_t i = 0; i < variants.size(); ++i)
        for (size_t j = i + 1; j < variants.size(); ++j)
            if (variants[i].variant == variants[j].variant && variants[i].point == variants[j].point)
                fail(where, ": variants: '", variants[i].variant, "' comes twice with the point '", variants[i].point,
                     "'; give the second a preset or a sweep that tells them apart");
}

}  // namespace

std::string label_of(const nlohmann::json& values) {
    std::string label;
    for (const auto& [name, value] : values.items())
        label +=
            (label.empty() ? "" : " ") + name + "=" + (value.is_string() ? value.get<std::string>() : value.dump());
    return label;
}

const std::vector<std::string>& target_names() {
    static const std::vector<std::string> names = {"specular", "image", "incident", "camera_radiance", "on_screen"};
    return names;
}

bool is_ladder_rung(const std::string& target) { return target == "camera_radiance" || target == "on_screen"; }

bool needs_ladder(const Config& config) { return std::ranges::any_of(config.targets, is_ladder_rung); }

Config read_config(const std::filesystem::path& file) {
    Config config;
    config.file = file;
    config.source = read_json(file);
    JsonObject object(config.source, file.string());
    config.title = object.text("title", file.stem().string());
    if (object.has("$schema")) object.text("$schema");

    for (JsonObject& shot : object.objects("shots")) read_shot(shot, file.parent_path(), config.shots);
    const std::optional<std::vector<unsigned>> seeds = read_seeds(object);
    for (JsonObject& variant : object.objects("variants")) read_variant(variant, seeds, config.variants);
    config.has_reference = !(object.has("reference") && object.any("reference") == "none");
    if (object.has("reference") && config.has_reference) config.reference = read_reference(object.object("reference"));
    config.direct_lit = object.choice("lit", {"path_traced", "direct"}, "path_traced") == "direct";
    if (!config.has_reference && !config.direct_lit)
        fail(file.string(), ": 'reference' = \"none\" leaves no path-traced light to read; add \"lit\": \"direct\"");

    config.composite = object.value_of<CompositeFormula>(
        "composite",
        {{"split_sum", CompositeFormula::split_sum}, {"additive_fresnel", CompositeFormula::additive_fresnel}});
    config.depth_format = object.value_of<DepthFormat>(
        "depth_format", {{"d32f", DepthFormat::d32f}, {"d24", DepthFormat::d24}, {"d16", DepthFormat::d16}});
    config.depth_direction = object.value_of<DepthDirection>(
        "depth_direction", {{"standard", DepthDirection::standard}, {"reversed", DepthDirection::reversed}});
    config.normal_bits =
        object.value_of<unsigned>("normal_encoding", {{"float", 0}, {"octahedral_16", 16}, {"octahedral_8", 8}});
    if (object.has("timing")) {
        JsonObject timing = object.object("timing");
        config.timing.frames = unsigned(timing.integer("frames", 0, 100000, int(config.timing.frames)));
        config.timing.warm_up = unsigned(timing.integer("warm_up", 1, 1000, int(config.timing.warm_up)));
        timing.finish();
        if (config.timing.frames > 0 && config.timing.frames < 15)
            fail(file.string(), ": timing: 'frames' = ", config.timing.frames,
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
            fail(file.string(), ": 'masks': ", e.what());
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
    check_tables(object);
    config.is_search = check_search(object, config.variants);
    object.finish();

    if (config.shots.empty()) fail(file.string(), ": 'shots' is missing or empty: name at least one scene");
    if (config.variants.empty())
        fail(file.string(), ": 'variants' is missing or empty: name at least one variant, e.g. \"none\"");
    refuse_repeated_shots(config.shots, file.string());
    refuse_repetition(config.variants, file.string());
    find_against_points(config.variants, file.string());
    return config;
}
