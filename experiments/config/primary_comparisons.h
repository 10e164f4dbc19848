#pragma once
#include "core/json.h"
#include "experiments/config/config.h"

/// The key `primary` of a study, if there is one; else mse, reflective and specular as far as the study measures
/// them, or else the first that it does. `config` holds what the study measures: metrics, masks and targets. Fails on
/// names that it does not, and on metrics of which less is not better.
PrimaryComparisons read_primary(JsonObject& study, const Config& config);
