#include "experiments/cli/config_of_study.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "experiments/study/table_columns.h"

namespace fs = std::filesystem;

fs::path included_studies() { return fs::path(SSRLAB_SOURCE_DIR) / "experiments/studies/configs"; }

fs::path study_file(const fs::path& asked) {
    std::error_code none;  // a name that is too long is none of a file
    if (asked.empty() || asked.has_parent_path() || asked.has_extension() || fs::exists(asked, none)) return asked;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(included_studies())) {
        if (entry.path().stem() == asked) return entry.path();
        names.push_back(entry.path().stem());
    }
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
