#include "experiments/live/watch/kept_versions.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/live/watch/watched_files.h"
#include "experiments/results/cells/host_info.h"

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

/// What the numbers of a version depend on, with the technique's folder as seen from here: both may move together.
json watched_in(const WatchSettings& settings) {
    return {{"technique", settings.folder.lexically_relative(settings.out).string()}, {"scenes", settings.scenes}};
}

/// Named by its place, which no file may change: a name in versions.json would be a path.
std::string name_of(const std::string& technique, size_t place) { return technique + "_" + std::to_string(place + 1); }

}  // namespace

WatchedPoint KeptVersion::point() const {
    return {.technique = std::string("./") + watch_folder::versions + "/" + name,
            .preset = preset,
            .label = name,
            .parameters = parameters};
}

KeptVersions::KeptVersions(const WatchSettings& settings)
    : out_(settings.out), technique_(settings.name()), of_(watched_in(settings)) {
    load();
    if (!fs::exists(part(watch_folder::technique, technique_))) return;  // no watch has worked here
    for (const char* of : {watch_folder::versions, watch_folder::kept_numbers})
        fs::remove_all(part(of, name_of(technique_, versions_.size())));
}

void KeptVersions::load() {
    const fs::path file = path_inside(out_, "versions.json");
    if (!fs::exists(file)) return;
    const json document = read_json(file);
    JsonObject list(document, file.string());
    if (list.has("of") && list.any("of") != of_)
        fail(out_.string(), " holds kept versions of another watch, ", shown(list.any("of")), ", not of ", shown(of_),
             "; name another folder with --out");
    for (JsonObject& entry : list.objects("versions")) {
        versions_.push_back({.name = name_of(technique_, versions_.size()),
                             .preset = entry.text("preset", ""),
                             .at = entry.text("at"),
                             .parameters = entry.any("parameters"),
                             .numbers = entry.any("numbers")});
        entry.finish();
    }
    list.finish();
}

fs::path KeptVersions::part(const char* of, const std::string& name) const {
    return path_inside(out_, std::string(of) + "/" + name);
}

const KeptVersion& KeptVersions::keep(const std::string& preset, const json& parameters, const json& numbers) {
    KeptVersion version{.name = name_of(technique_, versions_.size()),
                        .preset = preset,
                        .at = time_stamp(),
                        .parameters = parameters,
                        .numbers = numbers};
    copy_technique(part(watch_folder::technique, technique_), part(watch_folder::versions, version.name));
    const fs::path results = part(watch_folder::kept_numbers, version.name);
    write_atomically(results, [&](const fs::path& made) {
        fs::copy(path_inside(out_, watch_folder::now), made,
                 fs::copy_options::recursive | fs::copy_options::skip_symlinks);
        fs::remove_all(results);
    });
    json list = json::array();
    versions_.push_back(std::move(version));
    for (const KeptVersion& v : versions_)
        list.push_back({{"preset", v.preset}, {"at", v.at}, {"parameters", v.parameters}, {"numbers", v.numbers}});
    write_text(path_inside(out_, "versions.json"), json{{"of", of_}, {"versions", list}}.dump(1) + "\n");
    return versions_.back();
}
