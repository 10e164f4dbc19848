#include "core/json.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json_float.h"
#include "core/near_miss.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <cmath>

namespace {

using nlohmann::json;

/// Goes through a text in step with its parser, to find where each token begins.
class TokenPlaces {
public:
    TokenPlaces(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    /// The next token's place; steps over it. The parser has read that far: what is there is valid.
    JsonPlace next() {
        skip_between_tokens();
        const JsonPlace place{file_, line_, column_};
        const char first = step();
        if (first == '"') {
            for (char c = step(); c != '"'; c = step())
                if (c == '\\') step();
        } else if (!is_one_of(first, "{}[]")) {
            while (at_ < text_.size() && !is_one_of(text_[at_], "{}[],:/ \t\r\n")) step();
        }
        return place;
    }

private:
    static bool is_one_of(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }

    char step() {
        if (at_ == text_.size()) return '"';  // ends every token
        const char c = text_[at_++];
        ++column_;
        if (c == '\n') ++line_, column_ = 1;
        return c;
    }

    void skip_between_tokens() {
        if (at_ == 0 && text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark has no column
        while (at_ < text_.size()) {
            if (is_one_of(text_[at_], ",: \t\r\n"))
                step();
            else if (text_.substr(at_).starts_with("//"))
                step_to("\n");
            else if (text_.substr(at_).starts_with("/*"))
                step_to("*/");
            else
                return;
        }
    }
    void step_to(std::string_view end) {
        const size_t found = text_.find(end, at_ + 2);
        const size_t after = found == std::string_view::npos ? text_.size() : found + end.size();
        while (at_ < after) step();
    }

    std::string_view text_;
    const std::string& file_;
    size_t at_ = 0, line_ = 1, column_ = 1;
};

/// What is most likely wrong at `found`, where the library's `reason` says what it did not expect; "" if that is not
/// clear. `before`: the text up to there.
std::string_view likely_cause(std::string_view reason, std::string_view before, char found) {
    const auto has = [&](std::string_view part) { return reason.find(part) != std::string_view::npos; };
    const size_t last = before.find_last_not_of(" \t\r\n");
    const bool is_closing = found == '}' || found == ']';
    const bool is_no_token = has("invalid literal");
    if (is_no_token && found == '\'') return " (JSON texts stand in double quotes)";
    if (has("parsing object key - invalid literal") && found != '/') return " (JSON keys stand in double quotes)";
    if (is_closing && last != std::string_view::npos && before[last] == ',')
        return " (the comma before it is one too many)";
    if ((has("; expected '}'") || has("; expected ']'")) && !is_closing && !is_no_token && !has("end of input"))
        return " (is a comma missing before it?)";
    return "";
}

/// Builds a document from the parser's events: left to itself the library lets the last of two equal keys win, and
/// nests as deep as the file says.
class DocumentBuilder final : public nlohmann::json_sax<json> {
public:
    /// `places`, if not null, gets those of all values.
    DocumentBuilder(std::string_view text, const std::string& name, std::map<std::string, JsonPlace>* places = nullptr)
        : text_(text), name_(name), places_(places), tokens_(text, name) {}

    json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(json::number_integer_t value) override { return add(value); }
    bool number_unsigned(json::number_unsigned_t value) override { return add(value); }
    bool number_float(json::number_float_t value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(json::binary_t& value) override { return add(std::move(value)); }
    bool start_object(size_t) override { return open(json::object()); }
    bool start_array(size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(std::string& key) override {
        const auto [at, is_new] = open_.back()->get_ref<json::object_t&>().emplace(key, nullptr);
        keys_.back() = is_new ? key : "";
        if (!is_new) fail(name_, place(), ": the key '", shortened(key), "' comes twice in one object");
        member_ = &at->second;
        set_aside(member_bytes + double(key.size()));
        if (places_) note(member_pointer(pointers_.back(), key), tokens_.next());
        return true;
    }
    bool parse_error(size_t position, const std::string& last_token, const json::exception& e) override {
        if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
            fail(name_,
                 ": not valid JSON: the text is UTF-16, and JSON is UTF-8 (RFC 8259, 8.1); convert it, e.g. with ",
                 "iconv -f UTF-16 -t UTF-8");
        const size_t end = std::min(position ? position - 1 : 0, text_.size());
        const auto line = 1 + std::count(text_.begin(), text_.begin() + long(end), '\n');
        const size_t line_start = end == 0 ? std::string::npos : text_.rfind('\n', end - 1);
        const size_t column = end - (line_start == std::string::npos ? 0 : line_start + 1) + 1;
        constexpr int number_overflow = 406;
        if (e.id == number_overflow)
            fail(name_, ":", line, ":", column, place(), ": the number ", shortened(last_token),
                 " is beyond what float64 can hold");
        std::string reason = e.what();
        if (const size_t at = reason.rfind("syntax error"); at != std::string::npos) reason = reason.substr(at);
        fail(name_, ":", line, ":", column, ": not valid JSON: ", shortened(reason),
             likely_cause(reason, text_.substr(0, end), end < text_.size() ? text_[end] : '\0'));
    }

private:
    // Upper bounds of what they take in libstdc++: of an object's member the node of its map, of an array's element its
    // place in a vector that grows by doubling, of a place the node of its map without the texts in it.
    static constexpr double member_bytes = 112, element_bytes = 48, place_bytes = 144;

    /// In pieces of a megabyte, since every one looks at what all threads have.
    void set_aside(double bytes) {
        constexpr double piece = 1e6;
        waiting_ += bytes;
        if (waiting_ < piece) return;
        memory_.add(waiting_, name_ + ": its JSON");
        waiting_ = 0;
    }
    void note(std::string pointer, JsonPlace place) {
        set_aside(place_bytes + double(pointer.size() + place.file.size()));
        places_->insert_or_assign(std::move(pointer), std::move(place));
    }

    template <class Value>
    bool add(Value&& value) {
        if constexpr (std::is_same_v<std::decay_t<Value>, std::string>) set_aside(double(value.size()));
        json* at = slot();
        note_place();
        *at = std::forward<Value>(value);
        return true;
    }
    bool open(json container) {
        if (open_.size() == max_json_depth) fail(name_, ": its JSON nests more than ", max_json_depth, " levels");
        json* at = slot();
        pointers_.push_back(note_place());
        *at = std::move(container);
        open_.push_back(at), keys_.emplace_back();
        return true;
    }
    bool close() {
        open_.pop_back(), keys_.pop_back(), pointers_.pop_back();
        if (places_) tokens_.next();
        return true;
    }
    /// Notes where the value begins whose slot() was made, and returns its pointer; only if places are asked for.
    std::string note_place() {
        if (!places_) return "";
        const JsonPlace place = tokens_.next();
        if (open_.empty()) return "";
        if (open_.back()->is_object()) return member_pointer(pointers_.back(), keys_.back());  // its key is its place
        const std::string pointer = pointers_.back() + "/" + std::to_string(open_.back()->size() - 1);
        note(pointer, place);
        return pointer;
    }
    /// Where the next value goes. What is open stays in place: its parent grows only once it is closed.
    json* slot() {
        if (open_.empty()) return &root_;
        if (open_.back()->is_object()) return member_;
        set_aside(element_bytes);
        return &open_.back()->emplace_back(nullptr);
    }
    /// ": shots[0]: frames" inside of these.
    std::string place() const {
        std::string text;
        for (size_t i = 0; i < open_.size(); ++i) {
            if (open_[i]->is_array())
                text += "[" + std::to_string(open_[i]->size() - (i + 1 < open_.size())) + "]";
            else if (!keys_[i].empty())
                text += ": " + shortened(keys_[i]);
        }
        return text;
    }

    std::string_view text_;
    const std::string& name_;
    std::map<std::string, JsonPlace>* places_;
    TokenPlaces tokens_;
    json root_;
    std::vector<json*> open_;            ///< containers, outermost first
    std::vector<std::string> keys_;      ///< the last key of each that is an object
    std::vector<std::string> pointers_;  ///< to each of them; empty texts without places_
    json* member_ = nullptr;             ///< the value of the last key
    MemoryShare memory_;
    double waiting_ = 0;  ///< bytes not yet set aside
};

}  // namespace

json parse_json(std::string_view text, const std::string& name, bool allows_comments) {
    DocumentBuilder builder(text, name);
    json::sax_parse(text, &builder, json::input_format_t::json, /*strict=*/true, allows_comments);
    return builder.take();
}

json read_json(const std::filesystem::path& file) {
    return parse_json(read_text(file), file.string(), /*allows_comments=*/true);
}

JsonDocument read_json_document(const std::filesystem::path& file) {
    const std::string text = read_text(file), name = file.string();
    JsonDocument document;
    DocumentBuilder builder(text, name, &document.places);
    json::sax_parse(text, &builder, json::input_format_t::json, /*strict=*/true, /*ignore_comments=*/true);
    document.value = builder.take();
    return document;
}

std::vector<std::string> keys_of(const json& object) {
    return names_of(object.items(), [](const auto& member) { return member.key(); });
}

std::string member_pointer(const std::string& pointer, const std::string& key) {
    std::string escaped;
    for (const char c : key) escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return pointer + "/" + escaped;
}

std::string shown(const json& value) { return shortened(value.dump()); }

bool is_whole(const json& value) {
    if (!value.is_number_float()) return value.is_number_integer();
    constexpr double all_are_exact = 0x1p53;
    const auto number = value.get<double>();
    return std::trunc(number) == number && std::abs(number) <= all_are_exact;
}

json with_whole_as_integer(const json& value) {
    return value.is_number_float() && is_whole(value) ? json(value.get<int64_t>()) : value;
}

JsonObject::JsonObject(const nlohmann::json& object, std::string where) : object_(&object), file_(std::move(where)) {
    if (!object.is_object()) fail(file_, " must be a JSON object, not ", shown(object));
}

JsonObject::JsonObject(const JsonDocument& document, std::string file) : JsonObject(document.value, std::move(file)) {
    places_ = &document.places;
}

JsonObject::JsonObject(const nlohmann::json& object, const JsonObject& parent, const std::string& path,
                       std::string pointer)
    : object_(&object),
      file_(parent.file_),
      path_(parent.path_ + path),
      places_(parent.places_),
      pointer_(std::move(pointer)) {
    if (!object.is_object()) fail(where(), " must be a JSON object, not ", shown(object));
}

std::string JsonObject::at_pointer(const std::string& pointer) const {
    if (places_)
        if (const auto found = places_->find(pointer); found != places_->end()) {
            const JsonPlace& place = found->second;
            return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + path_;
        }
    return file_ + path_;
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
        fail(where(), " lacks the key '", key, "'");
    }
    return *found;
}

float JsonObject::number(const std::string& key, float min, float max) {
    const nlohmann::json& value = need(key);
    if (!value.is_number()) fail(at(key), ": '", key, "' must be a number, not ", shown(value));
    const auto number = value.get<double>();
    if (!(float(number) >= min && float(number) <= max) || !std::isfinite(float(number)))
        fail(at(key), ": '", key, "' = ", shown(value), " is outside [", min, ", ", max, "]");
    return float(number);
}

float JsonObject::number(const std::string& key, float min, float max, float fallback) {
    return find(key) ? number(key, min, max) : fallback;
}

int JsonObject::integer(const std::string& key, int min, int max) {
    const nlohmann::json& value = need(key);
    if (!is_whole(value)) fail(at(key), ": '", key, "' must be a whole number, not ", shown(value));
    const auto number = value.get<double>();  // larger ones are rounded, and stay outside
    if (number < min || number > max)
        fail(at(key), ": '", key, "' = ", shown(value), " is outside [", min, ", ", max, "]");
    return int(number);
}

int JsonObject::integer(const std::string& key, int min, int max, int fallback) {
    return find(key) ? integer(key, min, max) : fallback;
}

bool JsonObject::boolean(const std::string& key, bool fallback) {
    const nlohmann::json* value = find(key);
    if (!value) return fallback;
    if (!value->is_boolean()) fail(at(key), ": '", key, "' must be true or false, not ", shown(*value));
    return value->get<bool>();
}

std::string JsonObject::text(const std::string& key) {
    const nlohmann::json& value = need(key);
    if (!value.is_string()) fail(at(key), ": '", key, "' must be a text in quotes, not ", shown(value));
    return value.get<std::string>();
}

std::string JsonObject::text(const std::string& key, const std::string& fallback) {
    return find(key) ? text(key) : fallback;
}

std::vector<std::string> JsonObject::texts(const std::string& key) {
    const nlohmann::json* value = find(key);
    if (!value) return {};
    if (value->is_string()) return {value->get<std::string>()};
    const bool fits = value->is_array() && !value->empty() &&
                      std::ranges::all_of(*value, [](const nlohmann::json& v) { return v.is_string(); });
    if (!fits) fail(at(key), ": '", key, "' must be a text or an array of texts, not ", shown(*value));
    return value->get<std::vector<std::string>>();
}

std::string JsonObject::choice(const std::string& key, const std::vector<std::string>& choices,
                               const std::string& fallback) {
    const std::string value = text(key, fallback);
    if (std::ranges::find(choices, value) == choices.end())
        fail(at(key), ": '", key, "' = \"", shortened(value), "\" is not known", suggestion(value, choices));
    return value;
}

glm::vec3 JsonObject::vector(const std::string& key) {
    const nlohmann::json& value = need(key);
    const bool fits = value.is_array() && value.size() == 3 &&
                      std::ranges::all_of(value, [](const auto& v) { return v.is_number(); });
    if (!fits) fail(at(key), ": '", key, "' must be an array of three numbers, not ", shown(value));
    const std::string what = at(key) + ": '" + key + "'";
    return {float_of(value[0], what), float_of(value[1], what), float_of(value[2], what)};
}

glm::vec3 JsonObject::vector(const std::string& key, glm::vec3 fallback) { return find(key) ? vector(key) : fallback; }

const nlohmann::json& JsonObject::any(const std::string& key) { return need(key); }

std::vector<JsonObject> JsonObject::objects(const std::string& key) {
    const nlohmann::json* value = find(key);
    std::vector<JsonObject> list;
    if (!value) return list;
    if (!value->is_array()) fail(at(key), ": '", key, "' must be an array, not ", shown(*value));
    for (size_t i = 0; i < value->size(); ++i) {
        const std::string index = std::to_string(i);
        list.push_back(
            {(*value)[i], *this, ": " + key + "[" + index + "]", member_pointer(pointer_, key) + "/" + index});
    }
    return list;
}

JsonObject JsonObject::object(const std::string& key) {
    return {need(key), *this, ": " + key, member_pointer(pointer_, key)};
}

void JsonObject::finish() const {
    const std::vector<std::string> known(known_.begin(), known_.end());
    for (const auto& [key, value] : object_->items())
        if (!known_.contains(key)) fail(at(key), ": unknown key '", shortened(key), "'", suggestion(key, known));
}
