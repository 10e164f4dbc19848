#pragma once
#include "core/json.h"

#include <filesystem>

/// Reads a study's config and the configs that it `extends`, which may extend others. Each is a JSON merge patch (RFC
/// 7396) of the config that it names, except for `techniques`:
///
/// - An entry patches the entry of the same `technique` and `preset`, or is added if there is none.
/// - If several entries have them, `label` tells which entry is meant. A label that no entry has means the entry
///   without a label.
/// - `"remove": true` removes the entry.
///
/// The result has no `extends`; paths of captures are relative to the folder of `file`. Every value keeps its place for
/// messages. Every mistake is an Error that names the place.
JsonDocument read_extended(const std::filesystem::path& file);
