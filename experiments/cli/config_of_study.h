#pragma once
#include "experiments/study/config/config.h"

/// The studies that come with ssrlab (experiments/studies/studies.json): by group, and by the name of their config.
nlohmann::ordered_json included_studies();

/// The file of a study: `asked`, or the included one of this name if there is no such file. Fails with Error, and
/// suggests the nearest name, if `asked` is a mere name that neither has.
std::filesystem::path study_file(const std::filesystem::path& asked);

/// Reads the config of a study, given as for study_file(). Fails with Error if it is none, if it is for `ssrlab tune`,
/// or if its tables name what results do not have.
Config config_of_study(const std::filesystem::path& asked);

/// The default results folder: results/<name of the config>.
std::filesystem::path default_results(const std::filesystem::path& config);
