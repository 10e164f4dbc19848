#include "experiments/results/cells/finished_run.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/path_inside.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* record_name = "finished.json";

/// [bytes, time of the last change]; null if there is no such file.
nlohmann::json stamp_of(const fs::path& file) {
    std::error_code error, no_time;
    const auto size = fs::file_size(file, error);
    const auto changed = fs::last_write_time(file, no_time);
    if (error || no_time) return {};
    return {size, changed.time_since_epoch().count()};
}

}  // namespace

void keep_finished_run(const fs::path& results, const std::string& key, const std::vector<std::string>& said) {
    nlohmann::json files = nlohmann::json::object();
    std::error_code error;  // other processes may be at work in the folder
    for (auto entry = fs::recursive_directory_iterator(results, error); !error && entry != fs::end(entry);
         entry.increment(error)) {
        const fs::path& file = entry->path();
        std::error_code gone;
        if (entry->is_regular_file(gone) && file.extension() != ".claim" && file.filename() != record_name)
            files[file.lexically_relative(results).string()] = stamp_of(file);
    }
    if (error) return;
    write_text(path_inside(results, record_name),
               nlohmann::json{{"key", key}, {"said", said}, {"files", files}}.dump() + "\n");
}

std::optional<std::vector<std::string>> find_finished_run(const fs::path& results, const std::string& key) {
    try {
        const fs::path file_of_record = path_inside(results, record_name);
        if (std::error_code error; !fs::exists(file_of_record, error)) return {};
        const nlohmann::json record = read_json(file_of_record);
        if (record.at("key") != key) return {};
        for (const auto& [file, stamp] : record.at("files").items())
            if (stamp.is_null() || stamp_of(path_inside(results, file)) != stamp) return {};
        return record.at("said").get<std::vector<std::string>>();
    } catch (const MachineError&) {
        throw;
    } catch (const std::exception&) {  // as good as none
        return {};
    }
}
