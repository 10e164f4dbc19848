#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"

/// Keys of an entry of `shots`: of a scene, of a capture, and of either.
Keys scene_keys();
Keys capture_keys();
Keys keys_of_all_shots();
Values list_of_shots();

/// Keys of a study that set defaults of its shots: `resolution`, `lit`, `lit_specular`, `depth_format`, ...
Keys settings_of_shots();

/// Reads the key `shots` of `object`. An entry stands for all combinations of the values that its keys list. Paths of
/// captures are relative to `folder`. Every mistake is an Error that names place and key.
std::vector<ShotConfig> read_shots(ConfigObject& object, ConfigObject& study, const std::filesystem::path& folder);

/// The shot's `lit`, `lit_specular`, `depth_format`, `depth_direction` and `normal_encoding`, in the words of a config.
nlohmann::json shot_settings(const ShotConfig& shot);
