#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"

// Parts of a config that Python scripts read (tables.py, tune.py). They are checked here, so that a mistake shows
// before a study has run for hours. Every mistake is an Error that names file and key.

Values names_of_metrics();
Keys table_keys();
Keys tune_keys();

/// "tables" of the study, if it has any; `config`: what has been read of `study`.
void check_tables(ConfigObject& study, const Config& config);

/// An entry of `frozen`: which points stand for their techniques at a cost (evaluation/tradeoff/chosen_points.h).
Keys frozen_keys();
void check_frozen(ConfigObject& study, const Config& config);

/// "tune", if there is one; `config`: what has been read of `study`. All points are of one technique, the first becomes
/// the baseline if none is, and axes are parameters of it with allowed values. Sets config.is_tuned.
void check_tune(ConfigObject& study, Config& config);

/// "tune" of a study that read_config() has read, with its defaults, "seeds" and those of "judge" one by one.
nlohmann::json tuning_of(const Config& config);
