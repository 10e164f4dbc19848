#include "core/json_types.h"

#include "core/error.h"
#include "core/json.h"
#include "core/near_miss.h"

#include <limits>

namespace {

using nlohmann::json;

/// A value within others, whose name is made only where it is said.
struct Place {
    const Place* parent;
    std::string key;  ///< "": `index` counts
    size_t index = 0;

    std::string text() const {
        const std::string own = key.empty() ? "[" + std::to_string(index) + "]" : ": " + shortened(key);
        return parent ? parent->text() + own : key;
    }
};

bool is_of(const json& value, const std::string& type) {
    if (type == "text") return value.is_string();
    if (type == "number") return value.is_number();
    if (type == "true or false") return value.is_boolean();
    if (type == "object") return value.is_object();
    const uint64_t most = type == "count" ? std::numeric_limits<unsigned>::max() : std::numeric_limits<uint64_t>::max();
    return value.is_number_unsigned() && value.get<uint64_t>() <= most;
}

std::string shown_type(const std::string& type) {
    if (type == "true or false") return type;
    if (type == "object") return "an object";
    return type == "count" || type == "size" ? "a whole number from 0" : "a " + type;
}

void check(const json& value, const json& type, const Place& place, OtherMembers others);

void check_object(const json& value, const json& types, const Place& place, OtherMembers others) {
    if (!value.is_object()) fail(place.text(), " must be an object, not ", shown(value));
    size_t known = 0;
    for (const auto& [key, type] : types.items()) {
        const std::string name = key.substr(0, key.find('?'));
        const auto member = value.find(name);
        if (member == value.end() && name == key) fail(place.text(), " lacks '", name, "'");
        if (member == value.end()) continue;
        ++known;
        if (!member->is_null() || !key.ends_with("??")) check(*member, type, {&place, name}, others);
    }
    if (others == OtherMembers::allowed || known == value.size()) return;
    for (const auto& [name, member] : value.items())
        if (!types.contains(name) && !types.contains(name + "?") && !types.contains(name + "??"))
            fail(place.text(), ": '", shortened(name), "' is not known");
}

void check(const json& value, const json& type, const Place& place, OtherMembers others) {
    if (type.is_string()) {
        const auto& name = type.get_ref<const std::string&>();
        if (!is_of(value, name)) fail(place.text(), " must be ", shown_type(name), ", not ", shown(value));
    } else if (type.is_array()) {
        if (!value.is_array()) fail(place.text(), " must be an array, not ", shown(value));
        for (size_t i = 0; i < value.size(); ++i) check(value[i], type[0], {&place, "", i}, others);
    } else if (type.contains("*")) {
        if (!value.is_object()) fail(place.text(), " must be an object, not ", shown(value));
        for (const auto& [key, member] : value.items()) check(member, type["*"], {&place, key}, others);
    } else {
        check_object(value, type, place, others);
    }
}

}  // namespace

void require_type(const json& value, const json& type, const std::string& where, OtherMembers others) {
    check(value, type, {nullptr, where}, others);
}
