#pragma once
#include "experiments/config/config.h"

#include <string>
#include <vector>

/// Finds what each point with VariantConfig::against is compared with, wherever in the study it stands. Fails where no
/// point is the same but for these values; `where` names the config.
void find_against_points(std::vector<VariantConfig>& variants, const std::string& where);

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

/// A swept point that differs from a baseline of its variant in one parameter. A study may hold dozens: they belong
/// into the list of effects, not into every table and chart.
struct SingleChange {
    std::string variant, point, parameter;
    nlohmann::json value;
};

/// In the order of `variants`.
std::vector<SingleChange> single_changes(const std::vector<VariantConfig>& variants);
