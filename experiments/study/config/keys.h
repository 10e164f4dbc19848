#pragma once
#include "core/json.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

struct Key;

/// What a key of a config may hold.
struct Values {
    nlohmann::json schema;      ///< as JSON Schema
    std::string text;           ///< the same in words, as Markdown: "a whole number in [0, 64]"
    std::vector<Key> members;   ///< of an object whose keys are declared here
    nlohmann::json outer = {};  ///< what is checked with the key, if who reads what is inside checks that; null: all
};

/// What counts where a key is absent: a value, words where it is none or they are clearer, or both.
struct Default {
    template <class T>
    Default(const T& json, std::string text = "") : value(json), words(std::move(text)) {}

    nlohmann::json value;
    std::string words;
};
inline Default otherwise(std::string words) { return {nullptr, std::move(words)}; }
inline const Default none = otherwise("none"), required = otherwise("required");  ///< it must not be absent

/// A key of an object of a config: the only place that holds its name, values, default and meaning. How it is read and
/// checked, the JSON Schema and the tables of keys in experiments/README.md follow from it.
struct Key {
    std::string name;
    Values values;
    Default initial;
    std::string meaning;  ///< Markdown, with units
};
using Keys = std::vector<Key>;
Keys joined(Keys first, const Keys& second);

Values flag();
Values any_text();
Values whole(int min, int max);
Values number(double min, double max);
Values one_of(const std::vector<std::string>& names);
Values array_of(const Values& item, int least = 1);
Values either(const Values& a, const Values& b);
Values some_of(const Values& item);  ///< one, or an array of one or more
Values ascending(int max);           ///< an array of whole numbers from 0 to `max`, and ...
Values counts(int max);              ///< ... that, or a count up to `max`: what numbers_of() reads
Values object_of(const Keys& members);
/// The same values in other words, or with a part of their check left to who reads them: see Values::outer.
Values named(Values values, const std::string& text);
Values checked_inside(Values values, const std::string& type);

/// Fails unless the value, which `name` has, is one of these; `at` begins the message.
void check(const nlohmann::json& value, const Values& values, const std::string& name, const std::string& at);

/// JSON Schema of an object with these keys.
nlohmann::json schema_of(const Keys& keys);

/// A Markdown table of the keys, those of objects among them as `outer.inner`.
std::string key_table(const Keys& keys);

/// An object of a config, read by its declared keys. Every mistake is an Error that names place and key.
class ConfigObject {
public:
    /// Fails on keys that are not declared, with the nearest that is, on values that do not fit, and on missing keys.
    ConfigObject(JsonObject object, std::shared_ptr<const Keys> keys);
    ConfigObject(JsonObject object, Keys keys)
        : ConfigObject(std::move(object), std::make_shared<const Keys>(std::move(keys))) {}

    bool has(const std::string& key);
    /// The value, or the declared default. Fails with std::out_of_range if the key is not declared.
    const nlohmann::json& operator[](const std::string& key);
    template <class T>
    T get(const std::string& key) {
        return (*this)[key].template get<T>();
    }
    std::vector<std::string> texts(const std::string& key);  ///< of some_of() texts

    ConfigObject object(const std::string& key);               ///< of object_of()
    JsonObject plain(const std::string& key);                  ///< an object that who asks for it checks
    std::vector<JsonObject> elements(const std::string& key);  ///< an array of objects; empty if absent
    nlohmann::json values();                                   ///< of all keys that are there or have a default

    /// texts(), all of which must be among `known`.
    std::vector<std::string> known_texts(const std::string& key, const std::vector<std::string>& known);

    std::string where() const { return object_.where(); }
    std::string at(const std::string& key) const { return object_.at(key); }

    /// Fails with std::logic_error if a key is there that nobody has asked for: it is declared, but not read.
    void finish() const;

private:
    const Key& declared(const std::string& key) const;

    JsonObject object_;
    std::shared_ptr<const Keys> keys_;
    std::set<std::string> asked_;
};

/// A count n, which stands for 0 .. n-1, or an array of ascending whole numbers. `where` begins messages.
std::vector<unsigned> numbers_of(const nlohmann::json& value, const std::string& where);
