#include "metrics/direction.h"

#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>

namespace {

/// `of`: given the metric's declaration; nullopt for unknown names.
template <class Of>
auto declared(const std::string& name, const Of& of) -> std::optional<decltype(of(all_metrics().front()))> {
    for (const Metric& metric : all_metrics())
        if (metric.name == name) return of(metric);
    for (const TemporalMetric& metric : temporal_metrics())
        if (metric.name == name) return of(metric);
    return {};
}

}  // namespace

std::optional<Better> direction_of(const std::string& metric) {
    return declared(metric, [](const auto& m) { return m.better; });
}

double shortfall(Better better, double value) {
    switch (better) {
        case Better::lower:
            return value;
        case Better::higher:
            return -value;
        case Better::near_zero:
            return std::abs(value);
        case Better::near_one:
            return std::abs(value - 1);
    }
    return value;
}

bool is_error(const std::string& metric) { return direction_of(metric) == Better::lower; }

double greatest_value(const std::string& metric) {
    return declared(metric, [](const auto& m) { return m.greatest; }).value_or(INFINITY);
}
