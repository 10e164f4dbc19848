#pragma once
#include "core/json.h"

#include <filesystem>

/// A study's config with what it `extends`, which may extend another: each is a JSON merge patch (RFC 7396) of the one
/// that it names, but for `techniques`, whose entries patch those of the same `technique` and `preset` (a patch with a
/// `label` the one that has it, or else the one without any), or are added; with `"remove": true` they are taken away.
/// The result has no `extends`, and paths of captures relative to the folder of `file`. Every value keeps the place
/// that it was written at. Every mistake is an Error that names the place.
JsonDocument read_extended(const std::filesystem::path& file);
