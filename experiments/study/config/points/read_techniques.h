#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"
#include "variants/registry.h"

/// The keys of an entry of `techniques` that names this technique.
Keys technique_keys(const Technique& technique);

/// The keys of an entry of `techniques` that names another program's images.
Keys external_keys();

/// The key `seeds` of a study or an entry. read_seeds() returns nullopt if the object lacks it.
Values seeds();
std::optional<std::vector<unsigned>> read_seeds(ConfigObject& object);

/// Reads the keys `techniques` and `seeds` of a study: all points, in the order of their entries. `folder` is the
/// config's, to which paths in entries are relative. Every mistake is an Error that names place and key.
std::vector<PointConfig> read_techniques(ConfigObject& study, const std::filesystem::path& folder);
