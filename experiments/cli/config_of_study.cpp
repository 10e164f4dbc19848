#include "experiments/cli/config_of_study.h"

#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "experiments/study/table_columns.h"

#include <algorithm>

namespace fs = std::filesystem;

static fs::path included_folder() { return own_files() / "experiments/studies"; }

nlohmann::ordered_json included_studies() {
    return nlohmann::ordered_json::parse(read_text(included_folder() / "studies.json"));
}

fs::path study_file(const fs::path& asked) {
    std::error_code none;  // a name that is too long is none of a file
    const bool is_file = fs::exists(asked, none) && !fs::is_directory(asked, none);  // results may have a study's name
    if (asked.empty() || asked.has_parent_path() || asked.has_extension() || is_file) return asked;
    const nlohmann::ordered_json groups = included_studies();
    std::vector<std::string> names;
    for (const auto& [group, studies] : groups.items())
        for (const auto& [name, study] : studies.items()) names.push_back(name);
    if (std::ranges::count(names, asked.string()) > 0)
        return included_folder() / "configs" / (asked.string() + ".json");
    fail("there is no file '", shortened(asked.string()), "', and no included study of this name",
         suggestion(asked.string(), names, "ssrlab list studies"));
}

Config config_of_study(const fs::path& asked) {
    const fs::path file = study_file(asked);
    Config config = read_config(file);
    if (config.is_tuned) fail(file.string(), ": has a 'tune': `ssrlab tune` runs it");
    check_table_columns(config);
    return config;
}

fs::path default_results(const fs::path& config) { return fs::path("results") / config.stem(); }
