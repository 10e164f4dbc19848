#pragma once
#include "core/json.h"
#include "experiments/config/config.h"

/// The key `shots` of a study, and those that give its shots their defaults: `resolution`, `lit`, `depth_format`,
/// `depth_direction`, `normal_encoding`. An entry stands for all combinations of the values that its keys list. Paths
/// of captures are relative to `folder`. Every mistake is an Error that names place and key.
std::vector<ShotConfig> read_shots(JsonObject& study, const std::filesystem::path& folder);

/// Its `lit`, `depth_format`, `depth_direction` and `normal_encoding`, in the words of a config.
nlohmann::json shot_settings(const ShotConfig& shot);
