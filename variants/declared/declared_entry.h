#pragma once
#include "variants/common/variant_entry.h"

/// The name that a technique in this folder would have: the folder's own. Fails with Error if that cannot be one.
std::string declared_name(const std::filesystem::path& folder);

/// The entry of the technique that a folder's technique.json declares, with its tuned_presets.json left to the table.
/// Fails with Error, which names file and place, on what is wrong in it.
VariantEntry declared_entry(const std::filesystem::path& folder);
