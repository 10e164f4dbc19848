#pragma once
#include "metrics/metric.h"

/// ColorVideoVDP of stills, as a row of the table: cvvdp_0_5_6.
Metric cvvdp_metric();

/// How the settings show values to ColorVideoVDP: on a linear display radiance x 2^exposure_ev, else sRGB codes.
Viewing exposed_viewing(const MetricSettings& settings);
