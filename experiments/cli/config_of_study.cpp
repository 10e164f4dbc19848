#include "experiments/cli/config_of_study.h"

#include "core/error.h"
#include "experiments/study/table_columns.h"

Config config_of_study(const std::filesystem::path& file) {
    Config config = read_config(file);
    if (config.is_tuned) fail(file.string(), ": has a 'tune': `ssrlab tune` runs it");
    check_table_columns(config);
    return config;
}

std::filesystem::path default_results(const std::filesystem::path& config) {
    return std::filesystem::path("results") / config.stem();
}
