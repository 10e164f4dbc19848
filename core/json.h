#pragma once
#include <algorithm>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// Files nest some ten levels; what reads them may recurse, and a stack ends somewhere.
inline constexpr size_t max_json_depth = 100;

/// Parses a document that a file brings; `name` says which in messages. An Error names line and column of a syntax
/// error and of a number that float64 cannot hold, and the place of a key that comes twice in one object (RFC 8259
/// leaves open which of them counts) or of what is nested deeper than max_json_depth.
nlohmann::json parse_json(std::string_view text, const std::string& name, bool allows_comments = false);

/// parse_json() of a file, which may have comments.
nlohmann::json read_json(const std::filesystem::path& file);

/// The value as messages show it: JSON, cut where it is long.
std::string shown(const nlohmann::json& value);

/// Reads the members of one JSON object and remembers which were asked for, so that a misspelt key is an error instead of
/// a silent default. `where` begins each message, e.g. "scenes/fence/scene.json: cameras[0]".
class JsonObject {
public:
    JsonObject(const nlohmann::json& object, std::string where);

    bool has(const std::string& key);  ///< asking makes the key known

    float number(const std::string& key, float min, float max);                  ///< required, within [min, max]
    float number(const std::string& key, float min, float max, float fallback);  ///< optional
    int integer(const std::string& key, int min, int max);
    int integer(const std::string& key, int min, int max, int fallback);
    bool boolean(const std::string& key, bool fallback);
    std::string text(const std::string& key);
    std::string text(const std::string& key, const std::string& fallback);
    std::string choice(const std::string& key, const std::vector<std::string>& choices, const std::string& fallback);
    /// The value that stands beside the name; the first of them if the key is absent.
    template <class T>
    T value_of(const std::string& key, const std::vector<std::pair<std::string, T>>& choices) {
        std::vector<std::string> names;
        for (const auto& [name, value] : choices) names.push_back(name);
        const std::string chosen = choice(key, names, names.front());
        return choices[size_t(std::ranges::find(names, chosen) - names.begin())].second;
    }
    glm::vec3 vector(const std::string& key);
    glm::vec3 vector(const std::string& key, glm::vec3 fallback);
    const nlohmann::json& any(const std::string& key);           ///< required, of any type
    std::vector<JsonObject> objects(const std::string& key);     ///< an array of objects; empty if absent
    JsonObject object(const std::string& key);                   ///< required

    const std::string& where() const { return where_; }

    /// Fails on the first member that nobody asked for, with the nearest known key. Call it when all has been read.
    void finish() const;

private:
    const nlohmann::json* find(const std::string& key);
    const nlohmann::json& need(const std::string& key);

    const nlohmann::json* object_;
    std::string where_;
    std::set<std::string> known_;
};
