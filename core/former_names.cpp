#include "core/former_names.h"

#include <algorithm>
#include <cstdio>
#include <mutex>

namespace {

using nlohmann::json;
using nlohmann::literals::operator""_json_pointer;
using Names = std::map<std::string, std::string>;

const Names of_parameters = {{"resolve", "denoiser"}};
const Names of_studies = {{"variants", "techniques"},
                          {"variant", "technique"},
                          {"baseline_variant", "baseline_technique"},
                          {"against_variant", "against_technique"},
                          {"resolve", "denoiser"}};

void say_once(const std::string& former, const std::string& present) {
    static std::mutex mutex;
    static std::set<std::string> said;
    const std::lock_guard lock(mutex);
    if (said.insert(former).second)
        std::fprintf(stderr, "note: '%s' is read as '%s', its name\n", former.c_str(), present.c_str());
}

std::string present(const Names& names, const std::string& name) {
    const auto found = names.find(name);
    if (found == names.end()) return name;
    say_once(name, found->second);
    return found->second;
}

/// Whether a key or a text anywhere in `value` is a former name of some kind.
bool holds_former_name(const json& value) {
    const auto is_former = [](const std::string& text) {
        return of_studies.contains(text) || of_parameters.contains(text);
    };
    if (value.is_string()) return is_former(value.get_ref<const std::string&>());
    if (value.is_array()) return std::ranges::any_of(value, holds_former_name);
    if (!value.is_object()) return false;
    return std::ranges::any_of(value.items(), [&](const auto& member) {
        return is_former(member.key()) || holds_former_name(member.value());
    });
}

/// Writes a document anew.
class Renaming {
public:
    Renaming(const std::map<std::string, JsonPlace>& places, FormerNames which) : places_(places), which_(which) {}

    std::map<std::string, JsonPlace> places;
    bool searches_program = false;

    /// `from`, `to`: pointers to `value`. `renames_texts`: texts that are names of columns.
    json renamed(const json& value, const std::string& from, const std::string& to, bool renames_texts) {
        if (const auto place = places_.find(from); place != places_.end()) places[to] = place->second;
        if (value.is_object()) return renamed_members(value, from, to, renames_texts);
        if (value.is_string() && renames_texts) return present(of_studies, value);
        if (!value.is_array()) return value;
        json list = json::array();
        for (size_t i = 0; i < value.size(); ++i) {
            const std::string index = "/" + std::to_string(i);
            list.push_back(renamed(value[i], from + index, to + index, renames_texts));
        }
        return list;
    }

private:
    /// A technique may have a parameter `variant` of its own, and a program that is searched any.
    const Names& names_at(const std::string& pointer) const {
        static const Names none;
        if (pointer.starts_with("/tune")) return searches_program ? none : of_parameters;
        const bool is_of_entries = pointer.starts_with("/techniques/") || pointer.starts_with("/presets/");
        const bool is_in_entry = is_of_entries && std::ranges::count(pointer, '/') > 2;
        return which_ == FormerNames::of_technique || is_in_entry ? of_parameters : of_studies;
    }

    json renamed_members(const json& object, const std::string& from, const std::string& to, bool renames_texts) {
        const Names& names = names_at(to);
        json members = json::object();
        for (const auto& [key, value] : object.items()) {
            const bool is_kept = key == "shots" || (names.contains(key) && object.contains(names.at(key)));
            const std::string name = is_kept ? key : present(names, key);
            const bool is_of_columns =
                from.starts_with("/tables/") && (key == "rows" || key == "columns" || key == "over");
            const std::string pointer = member_pointer(from, key), place = member_pointer(to, name);
            members[name] =
                key == "shots" ? kept(value, pointer) : renamed(value, pointer, place, renames_texts || is_of_columns);
        }
        return members;
    }

    const json& kept(const json& value, const std::string& pointer) {
        for (const auto& [at, place] : places_)
            if (at == pointer || at.starts_with(pointer + "/")) places[at] = place;
        return value;
    }

    const std::map<std::string, JsonPlace>& places_;
    FormerNames which_;
};

}  // namespace

void take_former_names(JsonDocument& document, FormerNames which) {
    if (!holds_former_name(document.value)) return;  // no copy of the large ones, such as cells
    Renaming renaming(document.places, which);
    renaming.searches_program = document.value.contains("/tune/program"_json_pointer);
    document.value = renaming.renamed(document.value, "", "", false);
    document.places = std::move(renaming.places);
}

std::string present_path(std::string path) {
    static const std::string former = "resolves/", present = "denoisers/";
    if (!path.starts_with(former)) return path;
    say_once(former, present);
    return path.replace(0, former.size(), present);
}

std::string present_preset(const std::string& technique, const std::string& preset) {
    return technique == "composed_ssr" ? present({{"repaired", "corrected"}}, preset) : preset;
}

std::string present_word(const std::string& word, const std::vector<std::string>& before) {
    static const Names options = {{"--variants", "--techniques"}, {"--variant", "--technique"}};
    static const Names listed = {{"variants", "techniques"}, {"resolves", "denoisers"}};
    if (before.size() == 1 && before.front() == "list") return present(listed, word);
    const size_t equals = std::min(word.find('='), word.size());
    const bool is_option = word.starts_with("--");
    if (!is_option && equals == word.size()) return word;
    const bool is_term = !is_option && !before.empty() && before.back() == "--cells";
    if (!is_option && !is_term) return word;
    return present(is_option ? options : of_studies, word.substr(0, equals)) + word.substr(equals);
}
