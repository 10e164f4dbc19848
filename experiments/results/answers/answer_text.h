#pragma once
#include "core/list_text.h"
#include "experiments/results/answers/answers.h"

#include <optional>
#include <string>
#include <vector>

// Numbers, intervals and names as the answers' sentences have them.

/// Three significant digits, as a reader compares them.
std::string shown(double value);
/// Of a ratio `least_digits`; three near 1, where two would hide on which side it lies.
std::string shown_ratio(double ratio, int least_digits = 2);
std::string interval_text(const std::optional<double>& low, const std::optional<double>& high);

std::string name_of(const AnswerPoint& point);
/// As of names (list_text.h).
std::string listed(const std::vector<AnswerPoint>& points, size_t most);

/// A quotient with its 95 % interval.
struct Ratio {
    double value;
    std::optional<double> low, high;
};
/// With a third digit where two would show an interval as a point.
std::string shown(const Ratio& ratio);
