#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"

/// An entry of `shots` is of a scene or of a capture; the third are those of both.
Keys scene_keys();
Keys capture_keys();
Keys keys_of_all_shots();
Values list_of_shots();

/// Of a study, the defaults of its shots: `resolution`, `lit`, `lit_specular`, `depth_format`, ...
Keys settings_of_shots();

/// The key `shots` of an object of a study. An entry stands for all combinations of the values that its keys list.
/// Paths of captures are relative to `folder`. Every mistake is an Error that names place and key.
std::vector<ShotConfig> read_shots(ConfigObject& object, ConfigObject& study, const std::filesystem::path& folder);

/// Its `lit`, `lit_specular`, `depth_format`, `depth_direction` and `normal_encoding`, in the words of a config.
nlohmann::json shot_settings(const ShotConfig& shot);
