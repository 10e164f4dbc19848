#pragma once
#include "core/list_text.h"

#include <algorithm>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <ranges>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// Files nest about ten levels. Readers may recurse, and the stack is finite.
inline constexpr size_t max_json_depth = 100;

/// Parses the document of a file; `name` is the file in messages. Fails with Error, which names line and column, on a
/// syntax error or a number that float64 cannot hold. Also fails, and names the place, if an object has a key twice
/// (RFC 8259 leaves open which counts) or nesting exceeds max_json_depth.
nlohmann::json parse_json(std::string_view text, const std::string& name, bool allows_comments = false);

/// parse_json() of a file, which may have comments.
nlohmann::json read_json(const std::filesystem::path& file);

/// The keys of an object; empty for other values.
std::vector<std::string> keys_of(const nlohmann::json& object);

/// Where a value was written; line and column count from 1. A member of an object is at its key, an element of an array
/// at its first character.
struct JsonPlace {
    std::string file;
    size_t line = 0, column = 0;
};

/// A document that knows where its values were written, by JSON pointer (RFC 6901). The document itself has no place.
struct JsonDocument {
    nlohmann::json value;
    std::map<std::string, JsonPlace> places;
};

/// read_json() that keeps the places.
JsonDocument read_json_document(const std::filesystem::path& file);

/// The pointer to a member of what `pointer` points to.
std::string member_pointer(const std::string& pointer, const std::string& key);

/// The value as messages show it: JSON, cut where it is long.
std::string shown(const nlohmann::json& value);

/// Whether the number is whole: 3, 3.0 and 3e0 are the same to JSON (RFC 8259, section 6), and programs write each.
bool is_whole(const nlohmann::json& value);

/// The value, but whole numbers up to 2^53 as integers: 3 for 3.0.
nlohmann::json with_whole_as_integer(const nlohmann::json& value);

/// Reads the members of one JSON object and remembers which were asked for, so that a misspelt key is an error instead
/// of a silent default. Each message begins with, for example, "scenes/fence/scene.json: cameras[0]", or with the
/// places of a JsonDocument "scenes/fence/scene.json:12:7: cameras[0]".
class JsonObject {
public:
    JsonObject(const nlohmann::json& object, std::string where);
    /// The document's root; `file` is named where a message has no place. The document must outlive it.
    JsonObject(const JsonDocument& document, std::string file);

    bool has(const std::string& key);  ///< asking makes the key known

    float number(const std::string& key, float min, float max);                  ///< required, within [min, max]
    float number(const std::string& key, float min, float max, float fallback);  ///< optional
    int integer(const std::string& key, int min, int max);
    int integer(const std::string& key, int min, int max, int fallback);
    bool boolean(const std::string& key, bool fallback);
    std::string text(const std::string& key);
    std::string text(const std::string& key, const std::string& fallback);
    std::vector<std::string> texts(const std::string& key);  ///< a text, or an array of one or more; empty if absent
    std::string choice(const std::string& key, const std::vector<std::string>& choices, const std::string& fallback);
    /// The value beside the chosen name; the first value if the key is absent.
    template <class T>
    T value_of(const std::string& key, const std::vector<std::pair<std::string, T>>& choices) {
        const std::vector<std::string> names = names_of(std::views::keys(choices));
        const std::string chosen = choice(key, names, names.front());
        return choices[size_t(std::ranges::find(names, chosen) - names.begin())].second;
    }
    glm::vec3 vector(const std::string& key);
    glm::vec3 vector(const std::string& key, glm::vec3 fallback);
    const nlohmann::json& any(const std::string& key);        ///< required, of any type
    std::vector<JsonObject> objects(const std::string& key);  ///< an array of objects; empty if absent
    JsonObject object(const std::string& key);                ///< required

    std::string where() const { return at_pointer(pointer_); }  ///< of this object
    std::string at(const std::string& key) const { return at_pointer(member_pointer(pointer_, key)); }  ///< of a member

    /// Fails on the first member that was not read, with the nearest known key. Call it when all has been read.
    void finish() const;

private:
    const nlohmann::json* find(const std::string& key);
    const nlohmann::json& need(const std::string& key);

    JsonObject(const nlohmann::json& object, const JsonObject& parent, const std::string& path, std::string pointer);
    std::string at_pointer(const std::string& pointer) const;

    const nlohmann::json* object_;
    std::string file_, path_;  ///< path_: ": cameras[0]"
    const std::map<std::string, JsonPlace>* places_ = nullptr;
    std::string pointer_;
    std::set<std::string> known_;
};
