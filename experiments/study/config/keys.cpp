#include "experiments/study/config/keys.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/near_miss.h"

#include <re2/re2.h>
#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace {

using nlohmann::json;

bool has_type(const json& value, const std::string& type) {
    if (type == "integer") return is_whole(value);
    return type == "number"    ? value.is_number()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "array"   ? value.is_array()
                               : value.is_object();
}

bool fits(const json& value, const json& schema);

bool member_fits(const std::string& name, const json& value, const json& schema) {
    const json own = schema.value("properties", json::object()),
               others = schema.value("additionalProperties", json(true));
    if (own.contains(name)) return fits(value, own[name]);
    return others.is_boolean() ? others.get<bool>() : fits(value, others);
}

/// By the words of JSON Schema that declared keys use.
bool fits(const json& value, const json& schema) {
    const auto holds = [&](const std::string& word, const json& asked) {
        if (word == "type") return has_type(value, asked);
        if (word == "enum") return std::ranges::count(asked, value) > 0;
        if (word == "const") return value == asked;
        if (word == "pattern")  // std::regex recurses once per character, and a stack ends somewhere
            return RE2::PartialMatch(value.get<std::string>(), RE2(asked.get<std::string>()));
        if (word == "minimum") return value >= asked;
        if (word == "maximum") return value <= asked;
        if (word == "exclusiveMinimum") return value > asked;
        if (word == "minItems") return value.size() >= asked;
        if (word == "maxItems") return value.size() <= asked;
        if (word == "uniqueItems") return std::set<json>(value.begin(), value.end()).size() == value.size();
        if (word == "items") return std::ranges::all_of(value, [&](const json& item) { return fits(item, asked); });
        if (word == "anyOf") return std::ranges::any_of(asked, [&](const json& one) { return fits(value, one); });
        if (word == "required")
            return std::ranges::all_of(asked,
                                       [&](const json& name) { return value.contains(name.get<std::string>()); });
        if (word == "properties" || word == "additionalProperties")
            return std::ranges::all_of(
                value.items(), [&](const auto& member) { return member_fits(member.key(), member.value(), schema); });
        if (word == "description" || word == "default") return true;
        throw std::logic_error("fits() does not know '" + word + "'");
    };
    if (schema.contains("type") && !has_type(value, schema["type"])) return false;  // other words need it
    return std::ranges::all_of(schema.items(), [&](const auto& part) { return holds(part.key(), part.value()); });
}

/// All names that a schema lists, however deep.
void add_names(const json& schema, std::vector<std::string>& names) {
    if (schema.contains("enum"))
        for (const json& name : schema["enum"]) names.push_back(name);
    for (const json& one : schema.value("anyOf", json::array())) add_names(one, names);
    if (schema.contains("items")) add_names(schema["items"], names);
}

void add_rows(const Keys& keys, const std::string& outer, json& rows) {
    for (const Key& key : keys) {
        const Default& initial = key.initial;
        rows.push_back({{"key", outer + key.name},
                        {"values", key.values.text},
                        {"default", initial.words.empty() ? "`" + initial.value.dump() + "`" : initial.words},
                        {"meaning", key.meaning}});
        add_rows(key.values.members, outer + key.name + ".", rows);
    }
}

std::string alternatives(const std::vector<std::string>& names) {
    std::string list;
    for (size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "`" : i + 1 == names.size() ? " or `" : ", `") + names[i] + "`";
    return list;
}

}  // namespace

Keys joined(Keys first, const Keys& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

Values flag() { return {{{"type", "boolean"}}, "true or false", {}}; }
Values any_text() { return {{{"type", "string"}}, "a text", {}}; }
Values whole(int min, int max) {
    return {{{"type", "integer"}, {"minimum", min}, {"maximum", max}},
            "a whole number in [" + std::to_string(min) + ", " + std::to_string(max) + "]",
            {}};
}
Values number(double min, double max) {
    return {{{"type", "number"}, {"minimum", min}, {"maximum", max}},
            "a number in [" + shortest_digits(float(min)) + ", " + shortest_digits(float(max)) + "]",
            {}};
}
Values one_of(const std::vector<std::string>& names) { return {{{"enum", names}}, alternatives(names), {}}; }
Values array_of(const Values& item, int least) {
    return {{{"type", "array"}, {"items", item.schema}, {"minItems", least}}, "an array", {}};
}
Values either(const Values& a, const Values& b) {
    const auto outer = [](const Values& values) { return values.outer.is_null() ? values.schema : values.outer; };
    return {{{"anyOf", {a.schema, b.schema}}}, a.text + ", or " + b.text, a.members, {{"anyOf", {outer(a), outer(b)}}}};
}
Values some_of(const Values& item) { return named(either(item, array_of(item)), item.text + ", or an array of such"); }
Values ascending(int max) {
    Values list = named(array_of(whole(0, max)), "an ascending array of whole numbers");
    list.schema["uniqueItems"] = true;
    return list;
}
Values counts(int max) {
    return named(either(whole(1, max), ascending(max)), "a count n (0 .. n-1), or " + ascending(max).text);
}
Values object_of(const Keys& members) { return {schema_of(members), "an object", members, {{"type", "object"}}}; }
Values named(Values values, const std::string& text) {
    values.text = text;
    return values;
}
Values checked_inside(Values values, const std::string& type) {
    values.outer = {{"type", type}};
    return values;
}

void check(const json& value, const Values& values, const std::string& name, const std::string& at) {
    if (fits(value, values.outer.is_null() ? values.schema : values.outer)) return;
    std::vector<std::string> names;
    add_names(values.schema, names);
    for (const json& word : value.is_array() ? value : json::array({value}))
        if (word.is_string() && !fits(word, values.schema))
            if (const auto text = word.get<std::string>(); !nearest_name(text, names).empty())
                fail(at, ": '", name, "' = ", shown(word), " is not known", suggestion(text, names));
    fail(at, ": '", name, "' must be ", values.text, ", not ", shown(value));
}

json schema_of(const Keys& keys) {
    json members = json::object(), needed = json::array();
    for (const Key& key : keys) {
        json& schema = members[key.name] = key.values.schema;
        schema["description"] = key.meaning;
        if (!key.initial.value.is_null()) schema["default"] = key.initial.value;
        if (key.initial.words == required.words) needed.push_back(key.name);
    }
    return {{"type", "object"}, {"properties", members}, {"required", needed}, {"additionalProperties", false}};
}

json described(const Keys& keys) {
    json rows = json::array();
    add_rows(keys, "", rows);
    return rows;
}

ConfigObject::ConfigObject(JsonObject object, std::shared_ptr<const Keys> keys)
    : object_(std::move(object)), keys_(std::move(keys)) {
    for (const Key& key : *keys_) object_.has(key.name);
    object_.finish();
    for (const Key& key : *keys_)
        if (object_.has(key.name) || key.initial.words == required.words)
            check(object_.any(key.name), key.values, key.name, at(key.name));
}

const Key& ConfigObject::declared(const std::string& key) const {
    const auto found = std::ranges::find(*keys_, key, &Key::name);
    if (found == keys_->end()) throw std::out_of_range("'" + key + "' is not a declared key of a config");
    return *found;
}

bool ConfigObject::has(const std::string& key) {
    declared(key), asked_.insert(key);
    return object_.has(key);
}

const json& ConfigObject::operator[](const std::string& key) {
    return has(key) ? object_.any(key) : declared(key).initial.value;
}

std::vector<std::string> ConfigObject::texts(const std::string& key) {
    const json& value = (*this)[key];
    return value.is_string() ? std::vector{value.get<std::string>()} : value.get<std::vector<std::string>>();
}

std::vector<std::string> ConfigObject::known_texts(const std::string& key, const std::vector<std::string>& known) {
    const std::vector<std::string> names = texts(key);
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            fail(at(key), ": '", key, "' names \"", shortened(name), "\", which is not known", suggestion(name, known));
    return names;
}

ConfigObject ConfigObject::object(const std::string& key) {
    return {plain(key), std::shared_ptr<const Keys>(keys_, &declared(key).values.members)};
}

JsonObject ConfigObject::plain(const std::string& key) {
    has(key);
    return object_.object(key);
}

std::vector<JsonObject> ConfigObject::elements(const std::string& key) {
    has(key);
    return object_.objects(key);
}

json ConfigObject::values() {
    json all = json::object();
    for (const Key& key : *keys_)
        if (const json& value = (*this)[key.name]; !value.is_null()) all[key.name] = value;
    return all;
}

void ConfigObject::finish() const {
    JsonObject object = object_;
    for (const Key& key : *keys_)
        if (object.has(key.name) && !asked_.contains(key.name))
            throw std::logic_error(at(key.name) + ": '" + key.name + "' is declared, but nothing reads it");
}

std::vector<unsigned> numbers_of(const json& value, const std::string& where) {
    if (!value.is_array()) {
        std::vector<unsigned> list(value.get<unsigned>());
        std::iota(list.begin(), list.end(), 0u);
        return list;
    }
    const auto list = value.get<std::vector<unsigned>>();
    if (std::ranges::adjacent_find(list, std::greater_equal()) != list.end())
        fail(where, " must hold numbers in ascending order, each once");
    return list;
}
