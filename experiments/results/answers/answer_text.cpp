#include "experiments/results/answers/answer_text.h"

#include "core/list_text.h"
#include "core/number_text.h"

#include <algorithm>
#include <cmath>

std::string shown(double value) { return number_text(value, 3); }

std::string shown_ratio(double ratio, int least_digits) {
    const int digits = std::max(least_digits, std::abs(ratio - 1) < 0.1 ? 3 : 2);
    return (ratio < 9.95 ? number_text(ratio, digits) : fixed_text(ratio)) + "x";
}

std::string interval_text(const std::optional<double>& low, const std::optional<double>& high) {
    return low && high ? " [" + shown(*low) + ", " + shown(*high) + "]" : "";
}

std::string name_of(const AnswerPoint& p) { return point_text({p.technique, p.point}, p.label); }

std::string listed(const std::vector<AnswerPoint>& points, size_t most) {
    return listed(names_of(points, [](const AnswerPoint& p) { return name_of(p); }), most);
}

std::string shown(const Ratio& r) {
    if (!r.low || !r.high) return shown_ratio(r.value);
    const int digits = shown_ratio(*r.low) == shown_ratio(*r.high) ? 3 : 2;
    return shown_ratio(r.value, digits) + " [" + shown_ratio(*r.low, digits) + ", " + shown_ratio(*r.high, digits) +
           "]";
}
