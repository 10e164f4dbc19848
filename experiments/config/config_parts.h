#pragma once
#include "core/json.h"
#include "experiments/config/config.h"

// Parts of a config that Python scripts read (tables.py, tune.py). They are checked here, so that a mistake shows
// before a study has run for hours. Every mistake is an Error that names file and key.

/// What a table can be "of": those of tables.py (paper_tables/cells.py, SOURCES).
inline const std::vector<std::string> table_sources = {"effects",      "results", "splits",  "times",
                                                       "time_effects", "hits",    "costs",   "limits",
                                                       "agreement",    "eye",     "at_cost", "changes"};

/// "tables" of the study, if it has any; `config`: what has been read of `object`, the study.
void check_tables(JsonObject& object, const Config& config);

/// "tune", if there is one; `config`: what has been read of `object`, the study. All points are of one variant, the
/// first becomes the baseline if none is, and axes are parameters of it with allowed values. Sets config.is_tuned.
void check_tune(JsonObject& object, Config& config);
