#include "experiments/config/read_shots.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "experiments/config/capture_folder.h"
#include "experiments/config/config_values.h"
#include "metrics/ghost.h"

#include <algorithm>
#include <set>

namespace {

constexpr int max_side = 16384;  // pixels; what Vulkan devices commonly allow for an image
constexpr unsigned max_frames = 100000;

/// A choice that shots differ by: its name in results is the word itself.
template <class T>
struct Words {
    const char* key;
    std::vector<std::pair<std::string, T>> values;  ///< the first is the default
    T ShotConfig::*member;
};

/// Calls `use` for each of them, in the order in which names of shots have them.
template <class Use>
void for_each_choice(Use use) {
    static const Words<bool> lit = {"lit", {{"path_traced", false}, {"direct", true}}, &ShotConfig::direct_lit};
    static const Words<DepthFormat> formats = {
        "depth_format",
        {{"d32f", DepthFormat::d32f}, {"d24", DepthFormat::d24}, {"d16", DepthFormat::d16}},
        &ShotConfig::depth_format};
    static const Words<DepthDirection> directions = {
        "depth_direction",
        {{"standard", DepthDirection::standard}, {"reversed", DepthDirection::reversed}},
        &ShotConfig::depth_direction};
    static const Words<unsigned> normals = {
        "normal_encoding", {{"float", 0}, {"octahedral_16", 16}, {"octahedral_8", 8}}, &ShotConfig::normal_bits};
    use(lit), use(formats), use(directions), use(normals);
}

/// Each of the shots once with each of `count` changes.
template <class Change>
std::vector<ShotConfig> multiplied(const std::vector<ShotConfig>& shots, size_t count, const std::string& where,
                                   Change change) {
    if (shots.size() * count > most_shots)
        fail(where, " makes ", shots.size() * count, " shots of one entry; allowed are ", most_shots);
    std::vector<ShotConfig> all;
    for (const ShotConfig& shot : shots)
        for (size_t i = 0; i < count; ++i) change(all.emplace_back(shot), i);
    return all;
}

/// The words that an object has for a choice; empty if it has none.
template <class T>
std::vector<std::string> read_words(JsonObject& object, const Words<T>& choice) {
    std::vector<std::string> known;
    for (const auto& [word, value] : choice.values) known.push_back(word);
    return known_names(object, choice.key, known, {});
}

/// What of a choice a shot has: its own words, else the study's. What is not the study's first becomes part of its
/// name.
template <class T>
std::vector<ShotConfig> with_choice(const std::vector<ShotConfig>& shots, JsonObject& shot, JsonObject& study,
                                    const Words<T>& choice) {
    const std::vector<std::string> own = read_words(shot, choice), all = read_words(study, choice);
    const std::string usual = all.empty() ? choice.values.front().first : all.front();
    const std::vector<std::string> words = !own.empty() ? own : !all.empty() ? all : std::vector{usual};
    return multiplied(shots, words.size(), shot.at(choice.key) + ": '" + choice.key + "'",
                      [&](ShotConfig& config, size_t i) {
                          const auto is_named = [&](const auto& pair) { return pair.first == words[i]; };
                          config.*choice.member = std::ranges::find_if(choice.values, is_named)->second;
                          if (words[i] != usual) config.name_suffix += "." + words[i];
                      });
}

glm::uvec2 read_extent(const nlohmann::json& value, const std::string& where) {
    const bool fits =
        value.is_array() && value.size() == 2 && value[0].is_number_integer() && value[1].is_number_integer();
    if (!fits) fail(where, ": 'resolution' must be [width, height] in pixels, or an array of such, not ", shown(value));
    for (const auto& side : value)
        if (side < 1 || side > max_side)
            fail(where, ": 'resolution' ", shown(value), " is outside [1, ", max_side, "] pixels");
    return {value[0].get<unsigned>(), value[1].get<unsigned>()};
}

bool is_list_of(const nlohmann::json& value, auto is_wanted) {
    return value.is_array() && !value.empty() && std::ranges::all_of(value, is_wanted);
}

/// [width, height], or an array of such.
std::vector<glm::uvec2> read_extents(JsonObject& object) {
    const nlohmann::json& value = object.any("resolution");
    if (!is_list_of(value, [](const auto& v) { return v.is_array(); }))
        return {read_extent(value, object.at("resolution"))};
    std::vector<glm::uvec2> extents;
    for (const nlohmann::json& extent : value) extents.push_back(read_extent(extent, object.at("resolution")));
    return extents;
}

/// A count, an array of numbers, or {"from", "to"}, both included.
std::vector<unsigned> read_frames(const nlohmann::json& value, const std::string& where) {
    if (!value.is_object()) return read_numbers(value, where + ": 'frames'", max_frames);
    JsonObject range(value, where + ": frames");
    const int from = range.integer("from", 0, int(max_frames)), to = range.integer("to", from, int(max_frames));
    range.finish();
    std::vector<unsigned> frames;
    for (int frame = from; frame <= to; ++frame) frames.push_back(unsigned(frame));
    return frames;
}

/// One way to play the shot, or an array of arrays and ranges: several.
std::vector<std::vector<unsigned>> read_playings(JsonObject& shot) {
    if (!shot.has("frames")) return {{0}};
    const nlohmann::json& value = shot.any("frames");
    if (!is_list_of(value, [](const auto& v) { return v.is_structured(); }))
        return {read_frames(value, shot.at("frames"))};
    std::vector<std::vector<unsigned>> playings;
    for (const nlohmann::json& frames : value) playings.push_back(read_frames(frames, shot.at("frames")));
    return playings;
}

/// How a shot is played, its frames known.
void read_timeline(JsonObject& shot, ShotConfig& config) {
    config.measure_from = unsigned(shot.integer("measure_from", int(config.frames.front()), int(config.frames.back()),
                                                int(config.frames.front())));
    config.warm_up = unsigned(shot.integer("warm_up", 0, int(max_frames), 0));
    config.repeat = unsigned(shot.integer("repeat", 1, int(max_frames), 1));
    config.measures_last_only = shot.choice("measure", {"all", "last"}, "all") == "last";
    if (!shot.has("change")) return;
    config.change = unsigned(shot.integer("change", 0, int(max_frames)));
    if (std::ranges::find(config.frames, *config.change) == config.frames.end() ||
        config.change == config.frames.front())
        fail(shot.at("change"), ": 'change' = ", *config.change, " must be one of 'frames' after the first of them, ",
             config.frames.front());
    const size_t after =
        size_t(std::ranges::count_if(config.frames, [&](unsigned frame) { return frame >= *config.change; })) +
        config.repeat - 1;
    if (after < least_ghost_frames)
        fail(shot.at("change"), ": 'change' = ", *config.change, " is followed by ", after, " frames; at least ",
             least_ghost_frames, " must show how it fades: add 'frames', or a 'repeat' of the last");
}

void read_names(JsonObject& entry, std::vector<ShotConfig>& shots) {
    const std::string label = entry.text("label", ""), group = entry.text("group", "");
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
std::vector<ShotConfig> read_capture(JsonObject& shot, JsonObject& study, const std::filesystem::path& folder) {
    ShotConfig config{.gbuffer = folder / shot.text("gbuffer")};
    if (shot.has("reference")) config.reference = folder / shot.text("reference");
    config.frames.clear();
    if (shot.has("frames"))
        config.frames = read_frames(shot.any("frames"), shot.at("frames"));
    else
        for (const auto& [frame, path] : capture_frames(config.gbuffer)) config.frames.push_back(frame);
    read_timeline(shot, config);
    std::vector<ShotConfig> shots = {config};
    for_each_choice([&](const auto& choice) { shots = with_choice(shots, shot, study, choice); });
    read_names(shot, shots);
    shot.finish();
    return shots;
}

/// All combinations of what the entry lists; frames stay together, since a history runs through them.
std::vector<ShotConfig> read_entry(JsonObject shot, JsonObject& study, const std::filesystem::path& folder) {
    if (shot.has("gbuffer")) return read_capture(shot, study, folder);
    const std::vector<std::string> scenes = one_or_more(shot, "scene", ""), cameras = one_or_more(shot, "camera", "");
    if (!shot.has("scene")) shot.text("scene");  // says that it is missing
    std::vector<glm::uvec2> extents = {ShotConfig{}.extent};
    if (study.has("resolution")) extents = read_extents(study);
    if (shot.has("resolution")) extents = read_extents(shot);
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
    shots = multiplied(shots, extents.size(), where, [&](ShotConfig& c, size_t i) { c.extent = extents[i]; });
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
                 "'; tell them apart by {scene}, {camera}, {resolution}, {first_frame}, {last_frame} or {settings}");
    }
}

}  // namespace

std::vector<ShotConfig> read_shots(JsonObject& study, const std::filesystem::path& folder) {
    for_each_choice([&](const auto& choice) { read_words(study, choice); });  // known, whatever the shots say
    if (study.has("resolution")) read_extents(study);
    std::vector<ShotConfig> shots;
    for (JsonObject& entry : study.objects("shots")) {
        std::ranges::move(read_entry(entry, study, folder), std::back_inserter(shots));
        if (shots.size() > most_shots)
            fail(entry.where(), ": with it the study has ", shots.size(), " shots; allowed are ", most_shots);
    }
    refuse_repetition(shots, study.where());
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
