#include "experiments/results/tradeoff/tradeoff_answers.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/files/counts_spread.h"
#include "experiments/results/files/markdown.h"
#include "experiments/results/tradeoff/answer_context.h"
#include "experiments/results/verdicts/study_points.h"

#include <cmath>

namespace {

using nlohmann::json;
using Number = std::optional<double>;

Names markdown_names(Names names) {
    for (std::string& name : names) name = markdown_text(name);
    return names;
}

/// The head of answers.md, and what each change of a parameter gains and costs.
struct HeadAndChanges : AnswerContext {
    std::string head() const {
        const json study = manifest.value("study", json::object());
        std::string title = manifest.value("title", "");
        if (title.empty()) title = study.value("name", "");
        std::string text = "# " + markdown_text(title) + ": error against " + (is_timed() ? "time" : unit) + "\n\n";
        if (const std::string commits = commits_of(manifest); !commits.empty())
            text += "Made by " + markdown_code("ssrlab run " + study.value("config", "")) + " (commit " +
                    markdown_text(commits) + ") and `ssrlab tradeoff`.\n\n";
        const size_t scenes = distinct(between.shots, [](const auto& shot) { return shot->scene; }).size();
        text += message_text("Error: ", markdown_text(error.metric), " of ", markdown_code(error.target), " over ",
                             markdown_code(error.mask), " pixels, in ", counted(between.shots.size(), "shot"), " of ",
                             counted(scenes, "scene"), ". Ratios divide by the error of ", base,
                             ". Brackets hold 95 % intervals.\n");
        text += about_costs();
        for (const RefusedEstimate& refused : found.refused) {
            const Names shots = distinct(refused.shots, [&](const auto& s) { return markdown_text(shot_of(s).label); });
            text += "**" + markdown_text(label_of(refused.point)) + " has no estimate** in " +
                    listed(shots, most_listed) + " and is left out there: " + markdown_text(refused.refusal) + ".\n";
        }
        Names without;
        for (const auto& shot : between.shots)
            if (!shot->divisor) without.push_back(markdown_text(shot->label));
        if (!without.empty())
            text += "Ratios leave out " + joined(without, ", ") + ", because the error of " + base +
                    " is unknown there, or too small to divide by.\n";
        if (!manifest.value("is_complete", true)) text += "**The study is not complete: shots are missing.**\n";
        return text + "\n";
    }

    std::string about_costs() const {
        if (machines.empty())
            return is_timed() ? "Nothing was timed: errors alone are compared.\n"
                              : "No point has a cost (" + unit + "): errors alone are compared.\n";
        if (std::ranges::none_of(found.front, [](const FrontRow& row) { return row.cost.has_value(); }))
            return "Nothing was timed here. At each time, a technique is judged by the point that was chosen for this "
                   "time on the scenes of another study.\n";
        switch (found.kind) {
            case CostKind::timed:
                return "Times are medians of the sum of a technique's own stages. Measured on: " +
                       joined(markdown_names(machines), "; ") + "." +
                       (machines.size() > 1 ? " **Times of different machines or sizes are never compared below.**"
                                            : "") +
                       "\n" + doubts();
            case CostKind::estimated:
                return markdown_code(found.unit) +
                       ": microseconds that the chip would take for a technique's own stages. **No GPU ran anything**: "
                       "experiments/gpu_costs/chips/README.md lists what is assumed. " +
                       (found.costs_from.empty()
                            ? "Intervals of costs hold the sampling of invocations, and code of which it is unknown "
                              "whether it ran."
                            : means_over_places()) +
                       " Intervals do not hold the error of the assumptions. **The range of the model is wider**: " +
                       model_range_text() + ". Two costs that differ by less than a factor of " +
                       number_text(model_decides_from) +
                       " are undecided. A point surely fits a budget if it fits at the upper end of this range.\n";
            case CostKind::counted:
                return markdown_code(found.unit) +
                       ": counted over a technique's own stages with the first seed. Counts of a point's seeds differ "
                       "by up to " +
                       number_text(100 * counts_spread, 2) +
                       " %. Points that differ by less than twice this share are undecided. Times may order techniques "
                       "differently.\n";
        }
        return "";
    }

    std::string means_over_places() const {
        Names kinds;
        for (const CostsOfKind& kind : found.costs_from)
            kinds.push_back(message_text(kind.group.empty() ? "" : markdown_text(kind.group) + ": ",
                                         counted(kind.places, "place"), " at ", joined(kind.sizes, " and "),
                                         kind.widest > 0 ? ", within " + fixed_text(100 * kind.widest) + " %" : ""));
        return "Costs are means over the places of another study, and their intervals hold the scatter of these "
               "places (" +
               joined(kinds, "; ") + ").";
    }

    std::string doubts() const {
        Names unproven;
        size_t shots = 0;
        double floor = 0, most_busy = 0, sum_busy = 0, points = 0;
        for (const auto& shot : between.shots) {
            if (shot->curves.empty()) continue;
            ++shots, floor = std::max(floor, shot->floor);
            if (!shot->is_clock_proven) unproven.push_back(shot->label);
            for (const MeasuredPoint& p : shot->points)
                if (p.is_judged())
                    most_busy = std::max(most_busy, p.disturbed_share), sum_busy += p.disturbed_share, ++points;
        }
        std::string text;
        if (floor > 0)
            text += "Two copies of one point may differ by " + fixed_text(100 * floor) +
                    " % in a shot: smaller differences of times are undecided.\n";
        if (!manifest.value("clock", json::object()).contains("aa_floors"))
            text += "**No point was timed twice**: of the noise of times, only the scatter over frames is known.\n";
        if (!unproven.empty())
            text += message_text("**The timer was not validated in ", unproven.size(), " of ", shots,
                                 " shots** (manifest.json, `clock`).\n");
        if (most_busy > 0)
            text += "Other programs disturbed " + fixed_text(100 * sum_busy / points) + " % of the timed frames.\n";
        return text;
    }

    using ChangeKey = std::tuple<std::string, std::string, std::string, std::string>;
    static ChangeKey change_key(const ChangeRow* row) {
        return {row->technique, row->point, row->against_technique, row->against_point};
    }

    std::string stages() const {
        if (found.changes.empty()) return "";
        std::string text =
            "## What each change gains and costs\n\nEach row compares two points that differ in one parameter. A stage "
            "that is switched off may *save cost* and add error. The last column is the cost of each percent of "
            "error.\n\n";
        for (const std::string& machine : distinct(found.changes, &ChangeRow::machine)) {
            std::vector<const ChangeRow*> pooled, single;
            for (const ChangeRow& row : found.changes)
                if (row.machine == machine && row.shot.empty() && row.error_low) pooled.push_back(&row);
            for (const ChangeRow& row : found.changes)
                if (row.machine == machine && !row.shot.empty() &&
                    std::ranges::count(pooled, change_key(&row), change_key) == 0)
                    single.push_back(&row);
            text += "On " + markdown_text(machine) +
                    (pooled.empty() ? "" : ", over scenes (geometric mean of the error ratios, mean of the costs)") +
                    ":\n\n" + stage_table("scenes", pooled);
            if (!single.empty())
                text += "In each shot, because an interval over scenes needs at least four scenes:\n\n" +
                        stage_table("shot", single);
        }
        return text;
    }

    std::string stage_table(const std::string& first, std::vector<const ChangeRow*> rows) const {
        std::ranges::stable_sort(rows, {}, change_key);
        const auto percent = [](const Number& ratio) { return ratio ? Number(100 * (*ratio - 1)) : Number(); };
        std::vector<Names> cells;
        for (const ChangeRow* row : rows)
            cells.push_back({label_of({row->against_technique, row->against_point}) + ": " + row->change,
                             first == "shot" ? shot_of(row->shot).label : std::to_string(row->scenes),
                             measured(percent(row->error_ratio), percent(row->error_low), percent(row->error_high)),
                             measured(row->cost, row->cost_low, row->cost_high), row->verdict,
                             measured(row->cost_per_percent, row->cost_per_percent_low, row->cost_per_percent_high)});
        if (cells.empty()) return "";
        return markdown_table({"change", first, "% more error", unit + " more", "verdict", unit + " per % of error"},
                              cells);
    }
};

}  // namespace

std::string shown_number(const Number& value) {
    if (!value) return "";
    const std::string text = number_text(*value, 3);
    return *value == 0 ? "0" : text.find('e') == text.npos || std::abs(*value) < 1e-3 ? text : fixed_text(*value);
}

std::string measured(const Number& value, const Number& low, const Number& high) {
    if (!value || !low) return shown_number(value);
    return shown_number(value) + " [" + shown_number(low) + ", " + (high ? shown_number(high) : "...") + "]";
}

AnswerContext::AnswerContext(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             const BetweenPoints& between, const std::vector<double>& costs,
                             const std::vector<double>& factors)
    : manifest(tables.manifest),
      error(error),
      found(found),
      between(between),
      costs(costs),
      factors(factors),
      labels(point_labels(tables.manifest)),
      unit(markdown_text(found.unit)) {
    base_label = label_of(found.baseline), base = markdown_text(base_label);
    // Those with points at a cost: that timed something, or whose points are frozen.
    std::vector<const AcrossRow*> at_costs;
    for (const AcrossRow& row : found.across)
        if (!row.cost.empty()) at_costs.push_back(&row);
    machines = distinct(at_costs, &AcrossRow::machine);
}

const MeasuredShot& AnswerContext::shot_of(const std::string& name) const {
    return **std::ranges::find(between.shots, name, [](const auto& shot) { return shot->name; });
}

std::string commits_of(const json& manifest) {
    const auto commit = [](const json& maker) {
        const json program = maker.value("ssrlab", json::object()), name = program.value("commit", json());
        const json dirty = program.value("dirty", json());
        return (name.is_string() && !name.get<std::string>().empty() ? name.get<std::string>() : "unknown") +
               (dirty.is_boolean() && dirty ? " with changes" : "");
    };
    return joined(distinct(manifest.value("provenance", json::array()), commit), " and ");
}

std::string tradeoff_answers(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             const BetweenPoints& between, const std::vector<double>& costs,
                             const std::vector<double>& factors) {
    const AnswerContext context(tables, error, found, between, costs, factors);
    const HeadAndChanges own{context};
    std::string text = own.head() + answers_at_costs(context) + answers_of_shots(context) + own.stages();
    while (text.ends_with('\n')) text.pop_back();
    return text + "\n";
}
