#pragma once
#include "experiments/results/tradeoff/between_points.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Names and numbers that all parts of answers.md share.

using Names = std::vector<std::string>;

/// Three significant digits; "": none.
std::string shown_number(const std::optional<double>& value);
/// "1.2 [1.1, 1.3]"; without an interval the number alone.
std::string measured(const std::optional<double>& value, const std::optional<double>& low,
                     const std::optional<double>& high);

/// The distinct names, in order of first use.
Names distinct(auto&& items, auto&& name_of) {
    Names names;
    for (const auto& item : items)
        if (const std::string name = std::invoke(name_of, item); std::ranges::count(names, name) == 0)
            names.push_back(name);
    return names;
}

inline constexpr size_t most_listed = 4;  ///< names in a sentence

/// The question and the results of answers.md. All references must outlive this object.
struct AnswerContext {
    AnswerContext(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                  const BetweenPoints& between, const std::vector<double>& costs, const std::vector<double>& factors);

    const nlohmann::json& manifest;
    const PrimaryComparisons& error;
    const Tradeoff& found;
    const BetweenPoints& between;
    const std::vector<double>&costs, &factors;
    std::map<PointName, std::string> labels;
    std::string unit;              ///< of costs, in Markdown
    std::string base_label, base;  ///< the point that errors are multiples of; `base`: its name in Markdown
    Names machines;                ///< machines with points at a cost

    bool is_timed() const { return found.kind == CostKind::timed; }
    std::string label_of(const PointName& name) const { return point_text(name, labels); }
    const MeasuredShot& shot_of(const std::string& name) const;
};

/// Which technique at which cost, over scenes, and which at any cost, as Markdown.
std::string answers_at_costs(const AnswerContext& context);

/// Each shot's front and curves, and the errors that no cost removes, as Markdown.
std::string answers_of_shots(const AnswerContext& context);
