#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"
#include "variants/registry.h"

/// An entry of `techniques` that names this one.
Keys technique_keys(const Technique& technique);

/// An entry of `techniques` that names images of another program.
Keys external_keys();

/// The key `seeds` of a study or an entry; read_seeds() has none if it names none.
Values seeds();
std::optional<std::vector<unsigned>> read_seeds(ConfigObject& object);

/// The key `techniques` of a study, with its `seeds`: all points, in the order of their entries. Every mistake is an
/// Error that names place and key.
/// `folder`: that of the config, from which its entries name others.
std::vector<PointConfig> read_techniques(ConfigObject& study, const std::filesystem::path& folder);
