#pragma once
#include "experiments/study/config/config.h"

/// Fails with Error, which names the place in the config, if a table of the study (`tables`) names what the CSV file
/// that it is made of will not have: a column that is none and no parameter, or a metric, mask, target or technique.
void check_table_columns(const Config& config);
