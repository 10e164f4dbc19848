#pragma once
#include "core/json.h"
#include "experiments/config/config.h"

/// The key `variants` of a study, with its `seeds`: all points, in the order of their entries. Every mistake is an
/// Error that names place and key.
std::vector<VariantConfig> read_variants(JsonObject& study);
