#include "experiments/study/config/points/external_images.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/study/config/shots/shot.h"
#include "variants/registry.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

constexpr const char* description = "external.json";
constexpr int most_seeds = 1000;
constexpr float most_milliseconds = 1e6f;

bool is_name(const std::string& text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
               c == '.';
    });
}

/// A text that results use as a name.
std::string name_in(JsonObject& object, const std::string& key, const std::string& fallback) {
    const std::string name = fallback.empty() ? object.text(key) : object.text(key, fallback);
    if (!is_name(name))
        fail(object.at(key), ": '", key, "' = ", shown(name),
             " is not a valid name; use letters, digits, '_', '-' and '.' only");
    return name;
}

std::string stated(JsonObject& object, const std::string& key) {
    const std::string text = object.text(key);
    if (text.empty()) fail(object.at(key), ": '", key, "' is empty; name it, or write \"unknown\"");
    return text;
}

nlohmann::json read_settings(JsonObject& object) {
    if (!object.has("settings")) return nlohmann::json::object();
    const nlohmann::json& settings = object.any("settings");
    if (!settings.is_object()) fail(object.at("settings"), ": 'settings' must be an object, not ", shown(settings));
    for (const auto& [name, value] : settings.items())
        if (!value.is_string() && !value.is_number() && !value.is_boolean())
            fail(object.at("settings"), ": setting '", name, "' must be a text, a number, true or false, not ",
                 shown(value));
    return settings;
}

void refuse_own_name(JsonObject& object, const std::string& name) {
    if (std::ranges::find(technique_table(), name, &TechniqueEntry::name) != technique_table().end())
        fail(object.at("name"), ": 'name' = \"", name, "\" is a technique of ssrlab; give the images another name");
}

std::string frame_name(const Shot& shot, unsigned frame, const std::string& kind) {
    return ExternalImages::view_name(shot) + "/f" + std::to_string(frame) + "." + kind + ".exr";
}

}  // namespace

std::string ExternalImages::view_name(const Shot& shot) {
    return shot.scene.name + "." + shot.camera.name + "." + std::to_string(shot.config.extent.x) + "x" +
           std::to_string(shot.config.extent.y);
}

fs::path ExternalImages::image(const Shot& shot, unsigned frame, unsigned seed) const {
    return path_inside(folder, frame_name(shot, frame, "s" + std::to_string(seed)));
}

fs::path ExternalImages::proof(const Shot& shot, unsigned frame) const {
    return path_inside(folder, frame_name(shot, frame, "off"));
}

bool ExternalImages::has_view(const Shot& shot) const {
    std::error_code error;
    return fs::is_directory(path_inside(folder, view_name(shot)), error);
}

fs::path ExternalImages::half(const Shot& shot, unsigned frame, char which) const {
    return path_inside(folder, frame_name(shot, frame, std::string("half_") + which));
}

bool ExternalImages::has_halves(const Shot& shot, unsigned frame) const {
    std::error_code error;
    return has_given_light && fs::is_regular_file(half(shot, frame, 'a'), error) &&
           fs::is_regular_file(half(shot, frame, 'b'), error);
}

std::string ExternalImages::content_hash(const Shot& shot) const {
    ContentHash hash;
    hash.add(read_text(path_inside(folder, description)));
    for (const FrameStep& step : shot.steps) {
        if (!step.is_measured) continue;
        hash.add(read_text(proof(shot, step.frame)));
        for (unsigned seed = 0; seed < seeds; ++seed) hash.add(read_text(image(shot, step.frame, seed)));
        if (has_halves(shot, step.frame))
            for (const char which : {'a', 'b'}) hash.add(read_text(half(shot, step.frame, which)));
    }
    return hash.hex();
}

std::shared_ptr<const ExternalImages> read_external_images(const fs::path& folder, const std::string& where) {
    std::error_code error;
    const fs::path file = path_inside(folder, description);
    if (!fs::is_regular_file(file, error))
        fail(where, ": ", folder.string(), " holds no ", description, "; write one that says what rendered the images");
    const JsonDocument document = read_json_document(file);
    JsonObject object(document, file.string());
    auto images = std::make_shared<ExternalImages>();
    images->folder = folder;
    images->name = name_in(object, "name", "");
    refuse_own_name(object, images->name);
    images->point = name_in(object, "point", "default");
    images->engine = stated(object, "engine");
    images->version = stated(object, "version");
    images->driver = object.text("driver", "");
    images->licence = object.text("licence", "");
    images->settings = read_settings(object);
    images->seeds = unsigned(object.integer("seeds", 1, most_seeds, 1));
    images->has_given_light = object.boolean("given_light", false);
    if (object.has("milliseconds")) images->milliseconds = object.number("milliseconds", 0, most_milliseconds);
    object.finish();
    return images;
}

std::string why_not_external(const Shot& shot) {
    if (shot.config.repeat > 1) return "it has a 'repeat', but external images show each pose once";
    if (shot.config.change) return "it has a 'change', after which ghosts are measured for techniques only";
    return "";
}
