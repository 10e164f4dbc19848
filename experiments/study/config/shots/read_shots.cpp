#include "experiments/study/config/shots/read_shots.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/scene/scene_family.h"
#include "experiments/study/config/points/point_name.h"
#include "experiments/study/config/shots/capture_folder.h"
#include "metrics/ghost.h"

#include <algorithm>
#include <ranges>
#include <set>

namespace {

constexpr int max_side = 16384;  // pixels; what Vulkan devices commonly allow for an image
constexpr int max_frames = 100000;

/// A choice that shots differ by: its name in results is the word itself.
template <class T>
struct Words {
    const char *key, *meaning;
    std::vector<std::pair<std::string, T>> values;  ///< the first is the default
    T ShotConfig::*member;

    std::vector<std::string> names() const { return names_of(std::views::keys(values)); }
};

/// Calls `use` for each of them, in the order in which names of shots have them.
template <class Use>
void for_each_choice(Use use) {
    static const Words<bool> lit = {
        "lit",
        "Lit image that techniques read. `path_traced`: emission and diffuse light of the truth. `direct`: rasterised "
        "direct light without shadows, for very large scenes; the report says so",
        {{"path_traced", false}, {"direct", true}},
        &ShotConfig::direct_lit};
    static const Words<bool> specular = {
        "lit_specular",
        "Specular light in the lit image. `none`: reflections of reflections are black, and metals show only their "
        "emission. `environment`: the prefiltered environment times F0 A + F90 B, as in engines; reflections that a "
        "technique finds replace it",
        {{"none", false}, {"environment", true}},
        &ShotConfig::lit_has_environment};
    static const Words<bool> fallback = {
        "fallback",
        "What reflections show where a technique finds nothing. `environment`: the scene's environment. `probe`: a "
        "reflection probe, path-traced at the camera's place in the first frame. In a room use `probe`: otherwise the "
        "bright sky behind the walls decides the error",
        {{"environment", false}, {"probe", true}},
        &ShotConfig::has_probe};
    static const Words<DepthFormat> formats = {
        "depth_format",
        "Format of the depth buffer",
        {{"d32f", DepthFormat::d32f}, {"d24", DepthFormat::d24}, {"d16", DepthFormat::d16}},
        &ShotConfig::depth_format};
    static const Words<DepthDirection> directions = {
        "depth_direction",
        "Direction of depth. `reversed`: 1 at the near plane, 0 at the far plane",
        {{"standard", DepthDirection::standard}, {"reversed", DepthDirection::reversed}},
        &ShotConfig::depth_direction};
    static const Words<unsigned> normals = {
        "normal_encoding",
        "Encoding of the shading normals that techniques and composite read. `octahedral_16` and `octahedral_8` store "
        "two numbers of 16 or 8 bits (Cigolle et al. 2014). The truth is not affected",
        {{"float", 0}, {"octahedral_16", 16}, {"octahedral_8", 8}},
        &ShotConfig::normal_bits};
    static const Words<GBufferFormats> gbuffers = {
        "gbuffer_formats",
        "Formats of the G-buffer that techniques and composite read. `exact`: mostly 32-bit floats. `packed`: half "
        "floats and bytes, as in engines, about half the size. The truth is not affected",
        {{"exact", GBufferFormats::exact}, {"packed", GBufferFormats::packed}},
        &ShotConfig::gbuffer_formats};
    use(lit), use(specular), use(fallback), use(formats), use(directions), use(normals), use(gbuffers);
}

Values extents() {
    Values extent =
        named(array_of(whole(1, max_side), 2), "`[width, height]` in [1, " + std::to_string(max_side) + "]");
    extent.schema["maxItems"] = 2;
    return some_of(extent);
}

/// A range of frames, whose ends count.
Values frame_range() {
    const Values range = object_of(
        {{"from", whole(0, max_frames), required, "the first"}, {"to", whole(0, max_frames), required, "the last"}});
    return {range.schema, "`{\"from\": 20, \"to\": 51}`", {}};
}

Values playing() { return either(counts(max_frames), frame_range()); }

/// Each of the shots once with each of `count` changes.
template <class Change>
std::vector<ShotConfig> multiplied(const std::vector<ShotConfig>& shots, size_t count, const std::string& where,
                                   Change change) {
    if (shots.size() * count > most_shots)
        fail(where, " makes ", shots.size() * count, " shots from one entry; at most ", most_shots, " are allowed");
    std::vector<ShotConfig> all;
    for (const ShotConfig& shot : shots)
        for (size_t i = 0; i < count; ++i) change(all.emplace_back(shot), i);
    return all;
}

/// What of a choice a shot has: its own words, else the study's. What is not the study's first becomes part of its
/// name.
template <class T>
std::vector<ShotConfig> with_choice(const std::vector<ShotConfig>& shots, ConfigObject& shot, ConfigObject& study,
                                    const Words<T>& choice) {
    const std::vector<std::string> all = study.texts(choice.key);
    const std::vector<std::string> words = shot.has(choice.key) ? shot.texts(choice.key) : all;
    return multiplied(shots, words.size(), shot.at(choice.key) + ": '" + choice.key + "'",
                      [&](ShotConfig& config, size_t i) {
                          const auto is_named = [&](const auto& pair) { return pair.first == words[i]; };
                          config.*choice.member = std::ranges::find_if(choice.values, is_named)->second;
                          if (words[i] != all.front()) config.name_suffix += "." + words[i];
                      });
}

/// [width, height], or an array of such.
std::vector<glm::uvec2> extents_of(const nlohmann::json& value) {
    std::vector<glm::uvec2> extents;
    for (const nlohmann::json& extent : value[0].is_array() ? value : nlohmann::json::array({value}))
        extents.emplace_back(extent[0].get<unsigned>(), extent[1].get<unsigned>());
    return extents;
}

/// A count, an array of numbers, or {"from", "to"}, both included.
std::vector<unsigned> frames_of(const nlohmann::json& value, const std::string& where) {
    if (!value.is_object()) return numbers_of(value, where);
    std::vector<unsigned> frames;
    for (unsigned frame = value["from"]; frame <= value["to"].get<unsigned>(); ++frame) frames.push_back(frame);
    if (frames.empty()) fail(where, ": 'to' comes before 'from': ", shown(value));
    return frames;
}

/// One way to play the shot, or an array of arrays and ranges: several.
std::vector<std::vector<unsigned>> read_playings(ConfigObject& shot) {
    const nlohmann::json& value = shot["frames"];
    const std::string where = shot.at("frames") + ": 'frames'";
    if (!value.is_array() || !value[0].is_structured()) return {frames_of(value, where)};
    std::vector<std::vector<unsigned>> playings;
    for (const nlohmann::json& frames : value) playings.push_back(frames_of(frames, where));
    return playings;
}

/// How a shot is played, its frames known.
void read_timeline(ConfigObject& shot, ShotConfig& config) {
    const unsigned first = config.frames.front(), last = config.frames.back();
    config.measure_from = shot.has("measure_from") ? shot.get<unsigned>("measure_from") : first;
    if (config.measure_from < first || config.measure_from > last)
        fail(shot.at("measure_from"), ": 'measure_from' = ", config.measure_from, " is outside [", first, ", ", last,
             "], the shot's 'frames'");
    config.warm_up = shot.get<unsigned>("warm_up");
    config.repeat = shot.get<unsigned>("repeat");
    config.measures_last_only = shot["measure"] == "last";
    if (!shot.has("change")) return;
    config.change = shot.get<unsigned>("change");
    if (std::ranges::find(config.frames, *config.change) == config.frames.end() || config.change == first)
        fail(shot.at("change"), ": 'change' = ", *config.change, " must be one of 'frames' after the first of them, ",
             first);
    const size_t after =
        size_t(std::ranges::count_if(config.frames, [&](unsigned frame) { return frame >= *config.change; })) +
        config.repeat - 1;
    if (after < least_ghost_frames)
        fail(shot.at("change"), ": 'change' = ", *config.change, " is followed by ", after, " frames; at least ",
             least_ghost_frames, " must show how it fades: add 'frames', or a 'repeat' of the last");
}

void read_names(ConfigObject& entry, std::vector<ShotConfig>& shots) {
    const auto label = entry.get<std::string>("label"), group = entry.get<std::string>("group");
    for (ShotConfig& shot : shots) {
        const std::filesystem::path scene = shot.scene.empty() ? shot.gbuffer : std::filesystem::path(shot.scene);
        const nlohmann::json values = {
            {"scene", scene.stem().string()},
            {"camera", shot.camera},
            {"resolution", std::to_string(shot.extent.x) + "x" + std::to_string(shot.extent.y)},
            {"first_frame", shot.frames.front()},
            {"last_frame", shot.frames.back()},
            {"settings", shot.name_suffix.empty() ? "" : shot.name_suffix.substr(1)}};
        shot.label = fill_in(label, values, entry.at("label") + ": 'label'");
        shot.group = fill_in(group, values, entry.at("group") + ": 'group'");
    }
}

/// G-buffers from files; their paths are relative to the config's folder. Their format is the files' own, its light may
/// be the study's.
std::vector<ShotConfig> read_capture(ConfigObject& shot, const std::filesystem::path& folder) {
    ShotConfig config{.gbuffer = folder / shot.get<std::string>("gbuffer")};
    if (shot.has("reference")) {
        config.reference = folder / shot.get<std::string>("reference");
        if (config.reference.string().starts_with((folder / "").string()))
            config.reference_pattern_at = (folder / "").string().size();
    }
    config.frames.clear();
    if (shot.has("frames"))
        config.frames = frames_of(shot["frames"], shot.at("frames") + ": 'frames'");
    else
        for (const auto& [frame, path] : capture_frames(config.gbuffer)) config.frames.push_back(frame);
    read_timeline(shot, config);
    return {config};
}

/// The scenes that an entry names, of which `room:*` stands for `count` from number `first` on.
std::vector<std::string> read_scenes(ConfigObject& shot) {
    std::vector<std::string> scenes;
    const std::vector<std::string> names = shot.texts("scene");
    for (const char* key : {"count", "first"})
        if (shot.has(key) && std::ranges::none_of(names, names_several))
            fail(shot.at(key), ": '", key,
                 "' needs a family of scenes; write, for example, \"scene\": \"room:*\", or remove the key");
    for (const std::string& name : names) {
        if (!names_several(name)) {
            scenes.push_back(name);
            continue;
        }
        if (!shot.has("count"))
            fail(shot.at("scene"), ": 'scene' = \"", name,
                 "\" stands for several scenes; give their number as 'count'");
        try {
            std::ranges::move(scenes_in_a_row(name, shot.get<unsigned>("first"), shot.get<unsigned>("count")),
                              std::back_inserter(scenes));
        } catch (const Error& error) {
            fail(shot.at("count"), ": ", error.what());
        }
    }
    return scenes;
}

/// All combinations of scenes, cameras, frames and sizes; frames stay together, since a history runs through them.
std::vector<ShotConfig> read_views(ConfigObject& shot, ConfigObject& study) {
    const std::vector<std::string> scenes = read_scenes(shot), cameras = shot.texts("camera");
    const std::vector<glm::uvec2> extents = extents_of((shot.has("resolution") ? shot : study)["resolution"]);
    std::vector<ShotConfig> playings;
    for (std::vector<unsigned>& frames : read_playings(shot)) {
        playings.push_back({.frames = std::move(frames)});
        read_timeline(shot, playings.back());
    }
    const std::string where = shot.where();
    std::vector<ShotConfig> shots = multiplied({ShotConfig{}}, scenes.size(), where,
                                               [&](ShotConfig& config, size_t i) { config.scene = scenes[i]; });
    shots = multiplied(shots, cameras.size(), where, [&](ShotConfig& c, size_t i) { c.camera = cameras[i]; });
    shots = multiplied(shots, playings.size(), where, [&](ShotConfig& config, size_t i) {
        const ShotConfig before = std::exchange(config, playings[i]);
        config.scene = before.scene, config.camera = before.camera;
    });
    return multiplied(shots, extents.size(), where, [&](ShotConfig& c, size_t i) { c.extent = extents[i]; });
}

std::vector<ShotConfig> read_entry(JsonObject entry, ConfigObject& study, const std::filesystem::path& folder) {
    const bool is_capture = entry.has("gbuffer");
    ConfigObject shot(std::move(entry), joined(is_capture ? capture_keys() : scene_keys(), keys_of_all_shots()));
    std::vector<ShotConfig> shots = is_capture ? read_capture(shot, folder) : read_views(shot, study);
    for (ShotConfig& config : shots) config.named_at = {shot.at("scene"), shot.at("camera")};
    for_each_choice([&](const auto& choice) { shots = with_choice(shots, shot, study, choice); });
    read_names(shot, shots);
    shot.finish();
    return shots;
}

/// A shot that comes twice would do the same work under the same name, and one label for two would hide which is which.
void refuse_repetition(const std::vector<ShotConfig>& shots, const std::string& where) {
    std::set<std::string> labels;
    for (size_t i = 0; i < shots.size(); ++i) {
        const ShotConfig& shot = shots[i];
        const std::string name = shot.scene.empty() ? shot.gbuffer.string() : shot.scene;
        for (size_t j = 0; j < i; ++j)
            if (shot.is_played_like(shots[j]))
                fail(where, ": shots: '", name,
                     "' comes twice with the same camera, resolution and frames; leave one of them out");
        if (!shot.label.empty() && !labels.insert(shot.label).second)
            fail(where, ": shots: two have the label '", shot.label,
                 "'; distinguish them by {scene}, {camera}, {resolution}, {first_frame}, {last_frame} or {settings}");
    }
}

}  // namespace

Keys scene_keys() {
    return {{"scene", some_of(any_text()), required,
             "Names from `ssrlab list scenes`, or paths to .json, .gltf or .glb files. `room:17` is one room by its "
             "number, and `room:*` is several in a row; the same holds for `street:`"},
            {"count", whole(1, most_shots), otherwise("none"), "Number of scenes that `room:*` stands for"},
            {"first", whole(0, largest_scene_number), 0, "Number of the first of these scenes"},
            {"camera", some_of(any_text()), Default("", "the scene's first"), "Names of cameras of the scene"},
            {"resolution", extents(), otherwise("the study's"), "Resolution in pixels"},
            {"frames",
             named(either(playing(), array_of(either(ascending(max_frames), frame_range()))),
                   playing().text + ", or an array of such arrays and ranges"),
             nlohmann::json::array({0}),
             "Frames to render, in this order; each is a pose of camera and scene. An array of arrays or ranges makes "
             "several shots"}};
}

Keys capture_keys() {
    return {{"gbuffer", any_text(), required,
             "Folder of a captured frame or of a captured sequence (`experiments/bridges/captures/README.md`)"},
            {"reference", any_text(), otherwise("none: results are timed but not measured"),
             "Truth, as `ssrlab reference` writes it: one file, or `truth_####.exr` with one file for each frame"},
            {"frames", playing(), otherwise("all that are there"), "Frames to render, without gaps"}};
}

Keys keys_of_all_shots() {
    const ShotConfig plain;
    Keys keys = {{"warm_up", whole(0, max_frames), plain.warm_up,
                  "Frames rendered at the first pose before the measurement, so that histories converge"},
                 {"repeat", whole(1, max_frames), plain.repeat,
                  "How often the last pose is rendered in a row. With 2 or more repetitions of a single frame, flicker "
                  "is measured"},
                 {"change", whole(1, max_frames), otherwise("no step"),
                  "First of `frames` after a step of the scene. At least 8 frames must follow without motion. The "
                  "length of the ghost is then measured"},
                 {"measure", one_of({"all", "last"}), "all", "Frames that are measured: all `frames`, or the last"},
                 {"measure_from", whole(0, max_frames), otherwise("the first"),
                  "First frame that is measured. Earlier frames fill histories"},
                 {"label", any_text(), Default("", "its name"),
                  "Name of the shot in tables and figures; `{scene}`, `{camera}`, `{resolution}`, `{first_frame}`, "
                  "`{last_frame}` and `{settings}` are filled in"},
                 {"group", any_text(), Default("", "none"), "Name of a group of shots, with the same braces"}};
    for_each_choice([&](const auto& choice) {
        keys.push_back({choice.key, some_of(one_of(choice.names())), otherwise("the study's"), choice.meaning});
    });
    return keys;
}

Keys settings_of_shots() {
    Keys keys = {{"resolution", extents(), nlohmann::json::array({ShotConfig{}.extent.x, ShotConfig{}.extent.y}),
                  "Resolution in pixels of shots without their own"}};
    for_each_choice([&](const auto& choice) {
        keys.push_back({choice.key, some_of(one_of(choice.names())), choice.values.front().first, choice.meaning});
    });
    return keys;
}

Values list_of_shots() {
    const Keys common = keys_of_all_shots();
    const Values entry = either(object_of(joined(scene_keys(), common)), object_of(joined(capture_keys(), common)));
    return named(checked_inside(array_of(entry), "array"), "an array of shots");
}

std::vector<ShotConfig> read_shots(ConfigObject& object, ConfigObject& study, const std::filesystem::path& folder) {
    std::vector<ShotConfig> shots;
    for (JsonObject& entry : object.elements("shots")) {
        const std::string where = entry.where();
        std::ranges::move(read_entry(std::move(entry), study, folder), std::back_inserter(shots));
        if (shots.size() > most_shots)
            fail(where, ": with this entry the study has ", shots.size(), " shots; at most ", most_shots,
                 " are allowed");
    }
    refuse_repetition(shots, object.where());
    return shots;
}

nlohmann::json shot_settings(const ShotConfig& shot) {
    nlohmann::json settings;
    for_each_choice([&](const auto& choice) {
        const auto is_own = [&](const auto& pair) { return pair.second == shot.*choice.member; };
        settings[choice.key] = std::ranges::find_if(choice.values, is_own)->first;
    });
    return settings;
}
