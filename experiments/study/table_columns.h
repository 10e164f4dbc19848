#pragma once
#include "experiments/study/config/config.h"

/// Checks that the study's `tables` name only what their CSV files will have: columns, parameters, metrics, masks,
/// targets and techniques. Fails with Error that names the place in the config.
void check_table_columns(const Config& config);
