#include "experiments/study/config/extends.h"

#include "core/error.h"
#include "core/former_names.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

json::json_pointer to(const std::string& pointer) { return json::json_pointer(pointer); }

bool lies_in(const std::string& pointer, const std::string& outer) {
    return pointer.starts_with(outer) && (pointer.size() == outer.size() || pointer[outer.size()] == '/');
}

/// What the pointer points to, as a document of its own: its place is that of the pointer "".
JsonDocument part(const JsonDocument& document, const std::string& pointer) {
    JsonDocument cut{.value = document.value.at(to(pointer)), .places = {}};
    for (auto at = document.places.lower_bound(pointer); at != document.places.end(); ++at) {
        if (!at->first.starts_with(pointer)) break;
        if (lies_in(at->first, pointer)) cut.places[at->first.substr(pointer.size())] = at->second;
    }
    return cut;
}

void remove(JsonDocument& document, const std::string& key) {
    document.value.erase(key);
    std::erase_if(document.places, [&](const auto& place) { return lies_in(place.first, member_pointer("", key)); });
}

void put(JsonDocument& document, const std::string& pointer, JsonDocument value) {
    document.value[to(pointer)] = std::move(value.value);
    for (auto& [inner, place] : value.places) document.places[pointer + inner] = std::move(place);
}

/// RFC 7396.
JsonDocument merged(JsonDocument base, JsonDocument patch) {
    if (!patch.value.is_object()) return patch;
    if (!base.value.is_object()) base = {.value = json::object(), .places = {}};
    if (patch.places.contains("")) base.places[""] = patch.places[""];
    for (const auto& [key, value] : patch.value.items()) {
        const std::string pointer = member_pointer("", key);
        JsonDocument before = base.value.contains(key) ? part(base, pointer) : JsonDocument{};
        remove(base, key);
        if (!value.is_null()) put(base, pointer, merged(std::move(before), part(patch, pointer)));
    }
    return base;
}

/// Whether an entry's `technique` is a technique's folder, not the name of one of ssrlab's own.
bool names_folder(const json& technique) {
    return technique.is_string() && technique.get_ref<const std::string&>().find('/') != std::string::npos;
}

std::string place_of(const JsonDocument& document, const fs::path& file) {
    const auto found = document.places.find("");
    if (found == document.places.end()) return file.string();
    return found->second.file + ":" + std::to_string(found->second.line) + ":" + std::to_string(found->second.column);
}

/// A technique's name, or its folder however it is written.
bool is_same_technique(const json& a, const json& b) {
    const json of_a = a.value("technique", json("")), of_b = b.value("technique", json(""));
    if (!of_a.is_string() || !of_b.is_string()) return of_a == of_b;
    const auto plain = [](const json& name) { return fs::path(name.get<std::string>()).lexically_normal(); };
    return plain(of_a) == plain(of_b) && names_folder(of_a) == names_folder(of_b);
}

/// The entries that a patch of this technique, preset and label means: without a label any, with one those that have
/// it, or, where none has, those that have none and get it.
std::vector<size_t> entries_for(const json& patch, const std::vector<JsonDocument>& entries) {
    std::vector<size_t> all, same_label, unlabelled;
    for (size_t i = 0; i < entries.size(); ++i) {
        const json& entry = entries[i].value;
        const auto same = [&](const char* key) { return entry.value(key, json("")) == patch.value(key, json("")); };
        if (!entry.is_object() || !is_same_technique(entry, patch) || !same("external") || !same("preset")) continue;
        all.push_back(i);
        if (same("label")) same_label.push_back(i);
        if (!entry.contains("label")) unlabelled.push_back(i);
    }
    if (!patch.contains("label")) return all;
    return same_label.empty() ? unlabelled : same_label;
}

std::vector<JsonDocument> elements(const JsonDocument& array) {
    std::vector<JsonDocument> list;
    for (size_t i = 0; i < array.value.size(); ++i) list.push_back(part(array, "/" + std::to_string(i)));
    return list;
}

/// The entries of `base`, patched, and after them those that are new.
JsonDocument merged_techniques(const JsonDocument& base, const JsonDocument& patch, const fs::path& file) {
    std::vector<JsonDocument> entries = elements(base);
    for (JsonDocument& change : elements(patch)) {
        if (!change.value.is_object()) fail(place_of(change, file), ": techniques: an entry must be a JSON object");
        const json removes = change.value.value("remove", json(false));
        if (!removes.is_boolean())
            fail(place_of(change, file), ": techniques: 'remove' must be true or false, not ", shown(removes));
        change.value.erase("remove");
        const std::vector<size_t> meant = entries_for(change.value, entries);
        if (meant.size() > 1)
            fail(place_of(change, file), ": techniques: the extended config has ", meant.size(),
                 " entries with this 'technique' and 'preset'; give each a 'label' there, and name one here");
        if (meant.empty() && removes == true)
            fail(place_of(change, file), ": techniques: nothing to remove: the extended config has no such entry");
        if (removes == true)
            entries.erase(entries.begin() + long(meant.front()));
        else if (meant.size() == 1)
            entries[meant.front()] = merged(std::move(entries[meant.front()]), change);
        else
            entries.push_back(merged({}, change));
    }
    JsonDocument all{.value = json::array(), .places = {}};
    if (patch.places.contains("")) all.places[""] = patch.places.at("");
    for (size_t i = 0; i < entries.size(); ++i) put(all, "/" + std::to_string(i), std::move(entries[i]));
    return all;
}

/// Paths of captures, of external images and of techniques' folders are relative to the folder of the file that names
/// them.
void move_paths(json& config, const fs::path& from, const fs::path& to) {
    const auto move_in = [&](const char* list, const char* needed, const char* key) {
        if (!config.is_object() || !config.value(list, json()).is_array()) return;
        for (json& entry : config[list])
            if (entry.is_object() && entry.contains(needed) && entry.contains(key) && entry[key].is_string()) {
                const fs::path path = entry[key].get<std::string>();
                if (path.is_relative()) entry[key] = fs::proximate(from / path, to.empty() ? "." : to).string();
            }
    };
    move_in("shots", "gbuffer", "gbuffer");
    move_in("shots", "gbuffer", "reference");
    move_in("techniques", "external", "external");
    if (!config.is_object() || !config.value("techniques", json()).is_array()) return;
    for (json& entry : config["techniques"])
        if (entry.is_object() && names_folder(entry.value("technique", json()))) {
            const fs::path path = entry["technique"].get<std::string>();
            if (path.is_relative())
                entry["technique"] = "./" + fs::proximate(from / path, to.empty() ? "." : to).string();
        }
}

/// `chain`: the files that lead here.
JsonDocument read_chain(const fs::path& file, std::vector<fs::path> chain) {
    JsonDocument config = read_json_document(file);
    take_former_names(config, FormerNames::of_study);
    if (!config.value.is_object() || !config.value.contains("extends")) return config;
    JsonObject object(config, file.string());
    const fs::path base_file = file.parent_path() / object.text("extends");
    std::error_code error;
    if (!fs::is_regular_file(base_file, error))
        fail(object.at("extends"), ": 'extends': there is no file ", base_file.string());
    chain.push_back(fs::weakly_canonical(file));
    if (std::ranges::find(chain, fs::weakly_canonical(base_file)) != chain.end())
        fail(object.at("extends"), ": 'extends' leads back to ", base_file.string(), ", which extends this file");
    JsonDocument base = read_chain(base_file, chain);
    move_paths(base.value, base_file.parent_path(), file.parent_path());
    remove(config, "extends");
    const bool has_techniques = config.value.contains("techniques") && config.value["techniques"].is_array() &&
                                base.value.contains("techniques") && base.value["techniques"].is_array();
    if (!has_techniques) return merged(std::move(base), std::move(config));
    JsonDocument techniques = merged_techniques(part(base, "/techniques"), part(config, "/techniques"), file);
    remove(base, "techniques"), remove(config, "techniques");
    JsonDocument all = merged(std::move(base), std::move(config));
    put(all, "/techniques", std::move(techniques));
    return all;
}

}  // namespace

JsonDocument read_extended(const fs::path& file) { return read_chain(file, {}); }
