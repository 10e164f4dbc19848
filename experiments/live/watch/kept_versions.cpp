#include "experiments/live/watch/kept_versions.h"

#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/live/watch/watched_files.h"
#include "experiments/results/cells/host_info.h"

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

/// Named by its place, which no file may change: a name in versions.json would be a path.
std::string name_of(const std::string& technique, size_t place) { return technique + "_" + std::to_string(place + 1); }

}  // namespace

WatchedPoint KeptVersion::point() const {
    return {.technique = std::string("./") + watch_folder::versions + "/" + name,
            .preset = preset,
            .label = name,
            .parameters = parameters};
}

KeptVersions::KeptVersions(fs::path out, std::string technique)
    : out_(std::move(out)), technique_(std::move(technique)) {
    const fs::path file = out_ / "versions.json";
    if (!fs::exists(file)) return;
    const json document = read_json(file);
    JsonObject list(document, file.string());
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

const KeptVersion& KeptVersions::keep(const std::string& preset, const json& parameters, const json& numbers) {
    KeptVersion version{.name = name_of(technique_, versions_.size()),
                        .preset = preset,
                        .at = time_stamp(),
                        .parameters = parameters,
                        .numbers = numbers};
    create_folder(out_ / watch_folder::versions);
    copy_technique(out_ / watch_folder::technique / technique_, out_ / watch_folder::versions / version.name);
    const fs::path results = out_ / watch_folder::kept_numbers / version.name;
    fs::remove_all(results);
    create_folder(results.parent_path());
    fs::copy(out_ / watch_folder::now, results, fs::copy_options::recursive);
    json list = json::array();
    versions_.push_back(std::move(version));
    for (const KeptVersion& v : versions_)
        list.push_back({{"preset", v.preset}, {"at", v.at}, {"parameters", v.parameters}, {"numbers", v.numbers}});
    write_text(out_ / "versions.json", json{{"versions", list}}.dump(1) + "\n");
    return versions_.back();
}
