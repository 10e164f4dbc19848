#pragma once
#include "experiments/study/config/config.h"

#include <string>
#include <vector>

/// EffectRow::against of points that are compared with a point marked as a baseline.
inline const std::string baseline_name = "baseline";

/// What a point is compared with, and as what: baseline_name, or VariantConfig::against as text.
struct PointComparison {
    const VariantConfig *point, *baseline;
    std::string against;
};

/// Every point against every point marked as a baseline, and those with VariantConfig::against against that. `variants`
/// must outlive them.
std::vector<PointComparison> comparisons_of(const std::vector<VariantConfig>& variants);
