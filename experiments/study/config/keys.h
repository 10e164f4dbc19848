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
    std::vector<Key> members;   ///< declared keys, if the value is an object
    nlohmann::json outer = {};  ///< checked with the key, where a reader checks the inside; null: all of `schema`
};

/// The default of an absent key: a value, words that describe the default, or both.
struct Default {
    template <class T>
    Default(const T& json, std::string text = "") : value(json), words(std::move(text)) {}

    nlohmann::json value;
    std::string words;
};
inline Default otherwise(std::string words) { return {nullptr, std::move(words)}; }
inline const Default none = otherwise("none"), required = otherwise("required");  ///< the key must be present

/// A key of an object of a config: the one declaration of name, values, default and meaning. Reading, checking, the
/// JSON Schema and experiments/docs/reference/study_keys.md follow from it.
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
Values some_of(const Values& item);  ///< one item, or an array of at least one
Values ascending(int max);           ///< an array of ascending whole numbers in [0, max]
Values counts(int max);              ///< ascending(), or a count up to `max`: see numbers_of()
Values object_of(const Keys& members);
/// named(): the same values, described by other words. checked_inside(): the reader checks the inside, see
/// Values::outer; `type` is the JSON type that remains checked.
Values named(Values values, const std::string& text);
Values checked_inside(Values values, const std::string& type);

/// Fails with Error unless `value`, of the key `name`, is one of `values`; `at` begins the message.
void check(const nlohmann::json& value, const Values& values, const std::string& name, const std::string& at);

/// JSON Schema of an object with these keys.
nlohmann::json schema_of(const Keys& keys);

/// Name, values, default and meaning of each key as Markdown; keys of inner objects are named `outer.inner`.
nlohmann::json described(const Keys& keys);

/// An object of a config, read by its declared keys. Every mistake is an Error that names place and key.
class ConfigObject {
public:
    /// Fails with Error on undeclared keys (and suggests the nearest declared one), on values that do not fit, and on
    /// missing keys.
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
    std::vector<std::string> texts(const std::string& key);  ///< of a key with some_of() texts

    ConfigObject object(const std::string& key);               ///< of a key with object_of()
    JsonObject plain(const std::string& key);                  ///< an object whose keys the caller checks
    std::vector<JsonObject> elements(const std::string& key);  ///< an array of objects; empty if absent
    nlohmann::json values();                                   ///< all keys that are present or have a default

    /// texts() that must all be among `known`.
    std::vector<std::string> known_texts(const std::string& key, const std::vector<std::string>& known);

    std::string where() const { return object_.where(); }
    std::string at(const std::string& key) const { return object_.at(key); }

    /// Fails with std::logic_error if a present key was never asked for: a key that is declared and not read.
    void finish() const;

private:
    const Key& declared(const std::string& key) const;

    JsonObject object_;
    std::shared_ptr<const Keys> keys_;
    std::set<std::string> asked_;
};

/// The numbers that a value stands for: a count n for 0 .. n-1, or an array of ascending whole numbers. `where` begins
/// messages.
std::vector<unsigned> numbers_of(const nlohmann::json& value, const std::string& where);
