#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"
#include "variants/registry.h"

/// An entry of `variants` that names this one.
Keys variant_keys(const Variant& variant);

/// An entry of `variants` that names images of another program.
Keys external_keys();

/// The key `seeds` of a study or an entry; read_seeds() has none if it names none.
Values seeds();
std::optional<std::vector<unsigned>> read_seeds(ConfigObject& object);

/// The key `variants` of a study, with its `seeds`: all points, in the order of their entries. Every mistake is an
/// Error that names place and key.
/// `folder`: that of the config, from which its entries name others.
std::vector<VariantConfig> read_variants(ConfigObject& study, const std::filesystem::path& folder);
