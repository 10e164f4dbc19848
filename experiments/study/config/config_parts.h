#pragma once
#include "core/json.h"
#include "experiments/study/config/config.h"

// Parts of a config that Python scripts read (tables.py, search.py). They are checked here, so that a mistake shows
// before a study has run for hours. Every mistake is an Error that names file and key.

/// "tables" of the study, if it has any.
void check_tables(JsonObject& config);

/// "search", if there is one: axes are parameters of the study's only variant, and their values allowed ones. Returns
/// whether there is.
bool check_search(JsonObject& config, const std::vector<VariantConfig>& variants);
