#include "experiments/study/folder_owner.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/leftovers.h"
#include "core/path_inside.h"

#include <optional>
#include <set>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

json study_record(json config, bool keep_all) {
    if (config.is_object())
        for (const char* key : {"$schema", "tables"}) config.erase(key);  // neither changes a result
    return {{"config", config}, {"keep_all", keep_all}};
}

/// Whose the folder is; nothing if it is nobody's.
std::optional<json> read_owner(const fs::path& folder) {
    std::error_code error;
    const fs::path of_study = path_inside(folder, "study.json"), of_results = path_inside(folder, "manifest.json");
    if (fs::exists(of_study, error)) {
        const json record = read_json(of_study);
        if (record.is_object())
            return study_record(record.value("config", json()), record.value("keep_all", json()) == true);
        return study_record({}, false);
    }
    if (!fs::exists(of_results, error)) return {};
    const json manifest = read_json(of_results);
    return study_record(manifest.is_object() ? manifest.value("config", json()) : json(), false);
}

/// The keys in which two studies differ, for a message.
std::string differences(const json& a, const json& b) {
    if (a["keep_all"] != b["keep_all"]) return "--keep-all";
    if (!a["config"].is_object() || !b["config"].is_object()) return "its config";
    std::set<std::string> keys;
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const auto& [key, value] : (*one)["config"].items())
            if (!(*other)["config"].contains(key) || (*other)["config"][key] != value) keys.insert(key);
    std::string list;
    for (const std::string& key : keys) list += (list.empty() ? "'" : ", '") + key + "'";
    return list;
}

/// False if the file is there already. It appears whole, or not at all.
bool create(const fs::path& file, const std::string& text) {
    const fs::path draft = unfinished_path(file);
    write_text(draft, text);
    std::error_code error, ignored;
    fs::create_hard_link(draft, file, error);
    fs::remove(draft, ignored);
    if (!error || fs::exists(file, ignored)) return !error;
    write_text(file, text);  // a file system without links
    return true;
}

}  // namespace

FolderOwner::FolderOwner(const fs::path& folder, const Config& config, bool keep_all, bool replaces,
                         const std::function<void(const std::string&)>& notice)
    : folder_(folder) {
    const json record = study_record(config.source, keep_all);
    const fs::path file = folder / "study.json";
    std::optional<json> owner = read_owner(folder);
    if (!owner) {
        has_created_ = create(file, record.dump(1) + "\n");
        if (has_created_) return;
        owner = read_owner(folder);  // another process was faster
    }
    if (!owner) fail_machine("cannot read ", file.string(), ", which another process has just written");
    if (*owner != record) {
        if (!replaces)
            fail(folder.string(), " holds the results of another study, which differs in ", differences(*owner, record),
                 "; name another folder with --out, or give this one to the new study with --replace (cells that both "
                 "share are kept)");
        notice("note: the folder held the results of another study, which differed in " + differences(*owner, record));
    }
    std::error_code error;
    if (*owner != record || !fs::exists(file, error)) write_text(file, record.dump(1) + "\n");
}

FolderOwner::~FolderOwner() {
    std::error_code error;
    const bool has_cells = fs::exists(folder_ / "cells", error) && !fs::is_empty(folder_ / "cells", error);
    if (has_created_ && !has_cells && !fs::exists(folder_ / "manifest.json", error))
        fs::remove(folder_ / "study.json", error);
}

void check_owner(const fs::path& folder, const Config& config, bool keep_all) {
    const std::optional<json> owner = read_owner(folder);
    if (!owner) fail(folder.string(), " is no results folder: it has no study.json; `ssrlab run` makes one");
    if (const json record = study_record(config.source, keep_all); *owner != record)
        fail(folder.string(), " holds the results of another study, which differs in ", differences(*owner, record));
}
