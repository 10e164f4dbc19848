#pragma once
#include "experiments/study/config/config.h"

/// A study, by its config. Fails with Error where it is none, where it is `ssrlab tune`'s, and where its tables name
/// what results do not have.
Config config_of_study(const std::filesystem::path& file);

/// results/<name of the config>
std::filesystem::path default_results(const std::filesystem::path& config);
