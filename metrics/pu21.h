#pragma once
#include "metrics/metric.h"

/// PU21 codes (Mantiuk and Azimi 2021, "PU21: A novel perceptually uniform encoding for adapting existing quality
/// metrics for HDR", Picture Coding Symposium): equal steps are about equally visible. `light` in cd/m2, clamped to
/// [0.005, 10000]. The code is 0 at 0.005 cd/m2, 256 at 100 cd/m2, and at most 596.
double pu21_code(double light);

/// PSNR and SSIM of PU21 codes of what a display shows, as rows of the table: psnr_pu21, ssim_pu21.
std::vector<Metric> pu21_metrics();
