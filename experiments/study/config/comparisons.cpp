#include "experiments/study/config/comparisons.h"

#include "variants/registry.h"

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

std::vector<SingleChange> single_changes(const std::vector<VariantConfig>& variants) {
    const auto values_of = [](const VariantConfig& v) {
        return make_variant(v.variant, v.parameters, v.preset)->params.values();
    };
    std::vector<SingleChange> changes;
    for (const VariantConfig& v : variants) {
        if (v.is_baseline || v.swept.empty()) continue;  // a preset is compared as a whole
        const nlohmann::json own = values_of(v);
        for (const VariantConfig& baseline : variants) {
            if (!baseline.is_baseline || baseline.variant != v.variant) continue;
            const nlohmann::json other = values_of(baseline);
            std::vector<std::string> differing;
            for (const auto& [name, value] : own.items())
                if (other.at(name) != value) differing.push_back(name);
            if (differing.size() != 1) continue;
            changes.push_back({v.variant, v.point, differing.front(), own.at(differing.front())});
            break;
        }
    }
    return changes;
}
