#include "experiments/study/config/comparisons.h"

std::vector<PointComparison> comparisons_of(const std::vector<VariantConfig>& variants) {
    std::vector<PointComparison> comparisons;
    for (const VariantConfig& baseline : variants) {
        if (!baseline.is_baseline) continue;
        for (const VariantConfig& v : variants)
            if (v.variant != baseline.variant || v.point != baseline.point)
                comparisons.push_back({&v, &baseline, baseline_name});
    }
    for (const VariantConfig& v : variants)
        for (const VariantConfig& other : variants)
            if (!v.against_point.empty() && other.variant == v.variant && other.point == v.against_point)
                comparisons.push_back({&v, &other, label_of(v.against)});
    return comparisons;
}
