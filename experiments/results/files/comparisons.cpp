#include "experiments/results/files/comparisons.h"

std::vector<PointComparison> comparisons_of(const std::vector<ComparedPoint>& points) {
    std::vector<PointComparison> comparisons;
    for (const ComparedPoint& baseline : points) {
        if (!baseline.is_baseline) continue;
        for (const ComparedPoint& p : points)
            if (p.technique != baseline.technique || p.point != baseline.point)
                comparisons.push_back({&p, &baseline, baseline_name});
    }
    for (const ComparedPoint& p : points)
        for (const ComparedPoint& other : points)
            if (!p.against_point.empty() && other.technique == p.technique && other.point == p.against_point)
                comparisons.push_back({&p, &other, p.against});
    return comparisons;
}

std::string point_text(const PointName& name, const std::string& label) {
    if (!label.empty()) return label;
    const auto& [technique, point] = name;
    return point.empty() || point == "default" ? technique : technique + " " + point;
}

std::string point_text(const PointName& name, const std::map<PointName, std::string>& labels) {
    const auto own = labels.find(name);
    return point_text(name, own == labels.end() ? "" : own->second);
}
