#pragma once
#include "core/list_text.h"
#include "experiments/results/answers/answers.h"

#include <optional>
#include <string>
#include <vector>

// Numbers, intervals and names in the form that answers use.

/// Three significant digits.
std::string shown(double value);
/// A ratio with `least_digits` significant digits; with three near 1, where fewer would hide the side on which it lies.
std::string shown_ratio(double ratio, int least_digits = 2);
std::string interval_text(const std::optional<double>& low, const std::optional<double>& high);

std::string name_of(const AnswerPoint& point);
/// A list as in list_text.h.
std::string listed(const std::vector<AnswerPoint>& points, size_t most);

/// A quotient with its 95 % interval.
struct Ratio {
    double value;
    std::optional<double> low, high;
};
/// Uses a third digit where two would show the interval as a point.
std::string shown(const Ratio& ratio);
