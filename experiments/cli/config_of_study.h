#pragma once
#include "experiments/study/config/config.h"

/// Reads a study's config. Fails with Error if it is none, if it is for `ssrlab tune`, or if its tables name what
/// results do not have.
Config config_of_study(const std::filesystem::path& file);

/// The default results folder: results/<name of the config>.
std::filesystem::path default_results(const std::filesystem::path& config);
