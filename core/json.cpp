#include "core/json.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <cmath>
#include <fstream>

nlohmann::json read_json(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file)) fail("cannot read ", file.string(), ": no such file, or no permission");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    try {
        return nlohmann::json::parse(text, nullptr, true, /*ignore_comments=*/true);
    } catch (const nlohmann::json::parse_error& e) {
        const size_t end = std::min(e.byte ? e.byte - 1 : 0, text.size());
        const size_t line = 1 + std::count(text.begin(), text.begin() + end, '\n');
        const size_t line_start = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
        const size_t column = end - (line_start == std::string::npos ? 0 : line_start + 1) + 1;
        std::string reason = e.what();
        if (const size_t at = reason.rfind("syntax error"); at != std::string::npos) reason = reason.substr(at);
        fail(file.string(), ":", line, ":", column, ": not valid JSON: ", reason);
    }
}

JsonObject::JsonObject(const nlohmann::json& object, std::string where) : object_(&object), where_(std::move(where)) {
    if (!object.is_object()) fail(where_, " must be a JSON object, not ", object.dump());
}

bool JsonObject::has(const std::string& key) { return find(key); }

const nlohmann::json* JsonObject::find(const std::string& key) {
    known_.insert(key);
    const auto found = object_->find(key);
    return found == object_->end() ? nullptr : &*found;
}

const nlohmann::json& JsonObject::need(const std::string& key) {
    const nlohmann::json* found = find(key);
    if (!found) {
        finish();  // a misspelt key explains a missing one best
        fail(where_, " lacks the key '", key, "'");
    }
    return *found;
}

float JsonObject::number(const std::string& key, float min, float max) {
    const nlohmann::json& value = need(key);
    if (!value.is_number()) fail(where_, ": '", key, "' must be a number, not ", value.dump());
    const float number = value.get<float>();
    if (!(number >= min && number <= max))
        fail(where_, ": '", key, "' = ", value.dump(), " is outside [", min, ", ", max, "]");
    return number;
}

float JsonObject::number(const std::string& key, float min, float max, float fallback) {
    return find(key) ? number(key, min, max) : fallback;
}

int JsonObject::integer(const std::string& key, int min, int max) {
    const nlohmann::json& value = need(key);
    if (!value.is_number_integer()) fail(where_, ": '", key, "' must be a whole number, not ", value.dump());
    const auto number = value.get<long long>();
    if (number < min || number > max) fail(where_, ": '", key, "' = ", value.dump(), " is outside [", min, ", ", max, "]");
    return int(number);
}

int JsonObject::integer(const std::string& key, int min, int max, int fallback) {
    return find(key) ? integer(key, min, max) : fallback;
}

bool JsonObject::boolean(const std::string& key, bool fallback) {
    const nlohmann::json* value = find(key);
    if (!value) return fallback;
    if (!value->is_boolean()) fail(where_, ": '", key, "' must be true or false, not ", value->dump());
    return value->get<bool>();
}

std::string JsonObject::text(const std::string& key) {
    const nlohmann::json& value = need(key);
    if (!value.is_string()) fail(where_, ": '", key, "' must be a text in quotes, not ", value.dump());
    return value.get<std::string>();
}

std::string JsonObject::text(const std::string& key, const std::string& fallback) {
    return find(key) ? text(key) : fallback;
}

std::string JsonObject::choice(const std::string& key, const std::vector<std::string>& choices,
                               const std::string& fallback) {
    const std::string value = text(key, fallback);
    if (std::ranges::find(choices, value) == choices.end())
        fail(where_, ": '", key, "' = \"", value, "\" is not known", suggestion(value, choices));
    return value;
}

glm::vec3 JsonObject::vector(const std::string& key) {
    const nlohmann::json& value = need(key);
    const bool fits = value.is_array() && value.size() == 3 && std::ranges::all_of(value, [](const auto& v) { return v.is_number(); });
    if (!fits) fail(where_, ": '", key, "' must be an array of three numbers, not ", value.dump());
    const glm::vec3 vector(value[0].get<float>(), value[1].get<float>(), value[2].get<float>());
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(vector[i])) fail(where_, ": '", key, "' has the number ", value[i].dump(), ", which float32 cannot hold");
    return vector;
}

glm::vec3 JsonObject::vector(const std::string& key, glm::vec3 fallback) { return find(key) ? vector(key) : fallback; }

const nlohmann::json& JsonObject::any(const std::string& key) { return need(key); }

std::vector<JsonObject> JsonObject::objects(const std::string& key) {
    const nlohmann::json* value = find(key);
    std::vector<JsonObject> list;
    if (!value) return list;
    if (!value->is_array()) fail(where_, ": '", key, "' must be an array, not ", value->dump());
    for (size_t i = 0; i < value->size(); ++i)
        list.emplace_back((*value)[i], where_ + ": " + key + "[" + std::to_string(i) + "]");
    return list;
}

JsonObject JsonObject::object(const std::string& key) { return {need(key), where_ + ": " + key}; }

void JsonObject::finish() const {
    const std::vector<std::string> known(known_.begin(), known_.end());
    for (const auto& [key, value] : object_->items())
        if (!known_.contains(key)) fail(where_, ": unknown key '", key, "'", suggestion(key, known));
}
