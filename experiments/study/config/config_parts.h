#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/config/keys.h"

// Parts of a config that Python scripts read (tables.py, tune.py). They are checked here, so that a mistake shows
// before a study has run for hours. Every mistake is an Error that names file and key.

Values names_of_metrics();
Keys table_keys();
Keys tune_keys();

/// Checks "tables" of the study, if there is one. `config` holds what has been read of `study` so far.
void check_tables(ConfigObject& study, const Config& config);

/// The keys of an entry of `frozen`: the points that stand for their techniques at a cost
/// (results/tradeoff/chosen_points.h).
Keys frozen_keys();
void check_frozen(ConfigObject& study, const Config& config);

/// Checks "tune", if there is one, and sets config.is_tuned. All points must be of one technique; the first becomes the
/// baseline if none is. Axes must be its parameters, with allowed values. `config` holds what has been read so far.
void check_tune(ConfigObject& study, Config& config);

/// "tune" of a study that read_config() has read, with defaults filled in, and with "seeds" and the seeds of "judge" as
/// lists.
nlohmann::json tuning_of(const Config& config);
