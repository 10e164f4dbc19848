#include "experiments/results/tradeoff/tradeoff_answers.h"

#include "core/error.h"
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/tables/counts_spread.h"
#include "experiments/results/tables/markdown.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using nlohmann::json;
using Number = std::optional<double>;
using Names = std::vector<std::string>;

std::string printed(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Three significant digits.
std::string number(const Number& value) {
    if (!value) return "";
    const std::string text = printed("%.3g", *value);
    return *value == 0 ? "0" : text.find('e') == text.npos || std::abs(*value) < 1e-3 ? text : printed("%.0f", *value);
}

std::string measured(const Number& value, const Number& low, const Number& high) {
    if (!value || !low) return number(value);
    return number(value) + " [" + number(low) + ", " + (high ? number(high) : "...") + "]";
}

/// Of what is known from above alone: by its interval's upper end, where there is one.
std::string bound(const Number& value, const Number& high) {
    return high ? "at most " + number(high) : "about " + number(value);
}

std::string joined(const Names& names, const char* between) {
    std::string text;
    for (const std::string& name : names) text += (&name == &names.front() ? "" : between) + name;
    return text;
}

std::string listed(Names names) {
    constexpr size_t most = 4;
    if (names.size() > most) {
        const std::string more = std::to_string(names.size() - most) + " more";
        names.resize(most), names.push_back(more);
    }
    if (names.size() < 2) return joined(names, "");
    const std::string last = names.back();
    names.pop_back();
    return joined(names, ", ") + " and " + last;
}

/// Each once, in order.
Names distinct(auto&& items, auto&& name_of) {
    Names names;
    for (const auto& item : items)
        if (const std::string name = std::invoke(name_of, item); std::ranges::count(names, name) == 0)
            names.push_back(name);
    return names;
}

Names markdown_names(Names names) {
    for (std::string& name : names) name = markdown_text(name);
    return names;
}

/// Of the programs that made a study's cells.
std::string commits_of(const json& manifest) {
    const auto commit = [](const json& maker) {
        const json program = maker.value("ssrlab", json::object()), name = program.value("commit", json());
        const json dirty = program.value("dirty", json());
        return (name.is_string() && !name.get<std::string>().empty() ? name.get<std::string>() : "unknown") +
               (dirty.is_boolean() && dirty ? " with changes" : "");
    };
    return joined(distinct(manifest.value("provenance", json::array()), commit), " and ");
}

class Answers {
public:
    Answers(const StudyTables& tables, const PrimaryComparisons& error, const Tradeoff& found,
            const BetweenPoints& between, const std::vector<double>& costs, const std::vector<double>& factors)
        : manifest_(tables.manifest),
          error_(error),
          found_(found),
          between_(between),
          costs_(costs),
          factors_(factors),
          labels_(point_labels(tables.manifest)),
          unit_(markdown_text(found.unit)) {
        base_label_ = label_of(found.baseline), base_ = markdown_text(base_label_);
        // Those with points at a cost: that timed something, or whose points are frozen.
        std::vector<const AcrossRow*> at_costs;
        for (const AcrossRow& row : found.across)
            if (!row.cost.empty()) at_costs.push_back(&row);
        machines_ = distinct(at_costs, &AcrossRow::machine);
    }

    std::string text() const {
        std::string text = head() + at_costs() + whole() + shots() + floors() + stages();
        while (text.ends_with('\n')) text.pop_back();
        return text + "\n";
    }

private:
    using Rows = std::vector<const AcrossRow*>;

    bool is_timed() const { return found_.kind == CostKind::timed; }

    std::string label_of(const PointName& name) const {
        const auto own = labels_.find(name);
        if (own != labels_.end() && !own->second.empty()) return own->second;
        return name.second.empty() || name.second == "default" ? name.first : name.first + " " + name.second;
    }

    const MeasuredShot& shot_of(const std::string& name) const {
        return **std::ranges::find(between_.shots, name, [](const auto& shot) { return shot->name; });
    }

    std::string head() const {
        const json study = manifest_.value("study", json::object());
        std::string title = manifest_.value("title", "");
        if (title.empty()) title = study.value("name", "");
        std::string text = "# " + markdown_text(title) + ": error against " + (is_timed() ? "time" : unit_) + "\n\n";
        if (const std::string commits = commits_of(manifest_); !commits.empty())
            text += markdown_code("ssrlab run " + study.value("config", "")) + ", commit " + markdown_text(commits) +
                    "; then `ssrlab tradeoff`.\n\n";
        const size_t scenes = distinct(between_.shots, [](const auto& shot) { return shot->scene; }).size();
        text += message_text("Error: ", markdown_text(error_.metric), " of ", markdown_code(error_.target), " over ",
                             markdown_code(error_.mask), " pixels, ", between_.shots.size(), " shots of ", scenes,
                             " scenes; multiples are of the error of ", base_, ". In brackets 95 % intervals.\n");
        text += about_costs();
        for (const RefusedEstimate& refused : found_.refused) {
            const Names shots = distinct(refused.shots, [&](const auto& s) { return markdown_text(shot_of(s).label); });
            text += "**" + markdown_text(label_of(refused.point)) + " has no estimate** in " + listed(shots) +
                    " and is left out there: " + markdown_text(refused.refusal) + ".\n";
        }
        Names without;
        for (const auto& shot : between_.shots)
            if (!shot->divisor) without.push_back(markdown_text(shot->label));
        if (!without.empty())
            text += "Multiples leave out " + joined(without, ", ") + ": the error of " + base_ +
                    " is not known, or too small to divide by.\n";
        if (!manifest_.value("is_complete", true)) text += "**The study is not complete: shots are missing.**\n";
        return text + "\n";
    }

    std::string about_costs() const {
        if (machines_.empty())
            return is_timed() ? "Nothing was timed: errors alone are compared.\n" : "Nothing has " + unit_ + ".\n";
        if (std::ranges::none_of(found_.front, [](const FrontRow& row) { return row.cost.has_value(); }))
            return "Nothing was timed here: at a time stands what was chosen for it on the scenes of another study.\n";
        switch (found_.kind) {
            case CostKind::timed:
                return "Times are medians of the sum of a technique's own stages. Taken on " +
                       joined(markdown_names(machines_), "; ") + "." +
                       (machines_.size() > 1 ? " **Times of different machines or sizes are never compared below.**"
                                             : "") +
                       "\n" + doubts();
            case CostKind::estimated:
                return markdown_code(found_.unit) +
                       ": microseconds that the chip would take for a technique's own stages. **No GPU ran anything**: "
                       "what is assumed stands in experiments/gpu_costs/chips/README.md, and no interval holds whether "
                       "that is so. "
                       "Those of costs hold the sampling of invocations, and code of which it is not known whether it "
                       "ran. **What the model leaves open is wider**: " +
                       model_range_text() + ". Two costs closer than " + printed("%g", model_decides_from) +
                       " times are not decided, and a point surely fits what it would fit at the range's end.\n";
            case CostKind::counted:
                return markdown_code(found_.unit) +
                       ": counted over a technique's own stages with the first seed. Counts of a point's seeds spread "
                       "by up to " +
                       printed("%.2g", 100 * counts_spread) +
                       " %, so that points closer than twice that are not decided; times may order techniques "
                       "otherwise.\n";
        }
        return "";
    }

    std::string doubts() const {
        Names unproven;
        size_t shots = 0;
        double floor = 0, most_busy = 0, sum_busy = 0, points = 0;
        for (const auto& shot : between_.shots) {
            if (shot->curves.empty()) continue;
            ++shots, floor = std::max(floor, shot->floor);
            if (!shot->is_clock_proven) unproven.push_back(shot->label);
            for (const MeasuredPoint& p : shot->points)
                if (p.is_judged())
                    most_busy = std::max(most_busy, p.disturbed_share), sum_busy += p.disturbed_share, ++points;
        }
        std::string text;
        if (floor > 0)
            text += "Two copies of one point may differ by " + printed("%.0f", 100 * floor) +
                    " % in a shot: times within that are not distinguishable.\n";
        if (!manifest_.value("clock", json::object()).contains("aa_floors"))
            text += "**No point was timed twice**: of their noise only the scatter of frames is known.\n";
        if (!unproven.empty())
            text += message_text("**The timer was not validated in ", unproven.size(), " of ", shots,
                                 " shots** (manifest.json, `clock`).\n");
        if (most_busy > 0)
            text += "Other work disturbed " + printed("%.0f", 100 * sum_busy / points) + " % of the timed frames.\n";
        return text;
    }

    std::string at_costs() const {
        std::string text;
        for (const std::string& machine : machines_) {
            const bool is_nameless = machine.starts_with("not timed");  // frozen points need no times
            const std::string where = is_nameless ? "N" + machine.substr(1) : "On " + machine;
            const std::string who = who_stands();
            text += message_text("## Which technique at which ", is_timed() ? "time" : "cost", "\n\n",
                                 markdown_text(where), ", over scenes.", who.empty() ? "" : " ", who, "\n\n");
            std::vector<Names> cells;
            for (const double cost : costs_) cells.push_back(short_answer(machine, cost));
            text += markdown_table({unit_, "least error", "error / " + base_, "undecided beside it"}, cells);
            for (const double cost : costs_) text += at_cost(machine, cost);
        }
        return text;
    }

    std::string who_stands() const {
        bool some = false, others = false;
        for (const ChosenPoint& c : found_.chosen)
            if (!c.point.empty()) (c.chosen_on == "frozen" ? some : others) = true;
        if (!some) return "";
        return others ? "Some points were chosen on the scenes of another study (`frozen`), others here."
                      : "Each technique stands at the point that was chosen for it on the scenes of another study "
                        "(`frozen`).";
    }

    /// `cost`: none: of points, whatever they cost.
    Rows rows_at(const std::string& machine, const Number& cost, const std::string& group = "") const {
        Rows rows;
        const std::string text = cost ? printed("%.9g", *cost) : "";
        for (const AcrossRow& row : found_.across)
            if (row.cost == text && (!cost || row.machine == machine) && row.group == group) rows.push_back(&row);
        return rows;
    }

    static const AcrossRow* first_of(const Rows& rows) {
        const auto first = std::ranges::find_if(rows, [](const AcrossRow* row) { return row->rank == 1.0; });
        return first == rows.end() ? nullptr : *first;
    }

    Names short_answer(const std::string& machine, double cost) const {
        const Rows rows = rows_at(machine, cost);
        const AcrossRow* first = first_of(rows);
        if (!first || first->label == base_label_) return {number(cost), "none that fits in all scenes", "", ""};
        Names near;
        for (const AcrossRow* row : rows)
            if (row->rank && row != first && row->standing != standing::behind) near.push_back(row->label);
        return {number(cost), first->label, measured(first->ratio, first->low, first->high), joined(near, ", ")};
    }

    std::string at_cost(const std::string& machine, double cost) const {
        const Rows rows = rows_at(machine, cost);
        const std::string title = "### " + number(cost) + " " + unit_ + "\n\n";
        if (rows.empty()) return title + "No point fits in any scene.\n\n";
        const size_t scenes = rows.front()->of_scenes;
        std::string text = title + first_sentence(rows) + "\n";
        Names partly, fitting, absent;
        for (const AcrossRow* row : rows) {
            if (row->scenes < scenes)
                partly.push_back(message_text(markdown_text(row->label), " (", row->scenes, " of ", scenes,
                                              " scenes, there ", measured(row->ratio, row->low, row->high), " of ",
                                              base_, "'s error)"));
            fitting.push_back(row->scenes_that_fit ? message_text(*row->scenes_that_fit, " of ", scenes) : "");
        }
        if (!partly.empty()) text += "Not ranked, since they do not fit everywhere: " + joined(partly, "; ") + ".\n";
        for (const auto& shot : between_.shots)
            for (const auto& [variant, curve] : shot->curves)
                if (std::ranges::count(absent, variant) == 0 &&
                    std::ranges::count(rows, variant, &AcrossRow::variant) == 0)
                    absent.push_back(variant);
        std::ranges::sort(absent);
        if (!absent.empty()) text += "In no scene fit " + markdown_text(listed(absent)) + ".\n";
        return text + "\n" + ranking("technique", rows, "surely fits in scenes", fitting) +
               groups_at(machine, cost, rows);
    }

    /// Each technique in each group of shots, where the study has several.
    std::string groups_at(const std::string& machine, double cost, const Rows& all) const {
        Names groups = distinct(found_.across, &AcrossRow::group), head = {"technique"};
        std::erase(groups, "");
        if (groups.empty()) return "";
        for (const std::string& group : groups) {
            size_t scenes = 0;
            for (const AcrossRow* row : rows_at(machine, cost, group)) scenes = std::max(scenes, row->scenes);
            head.push_back(message_text(group, " (", scenes, ")"));
        }
        std::vector<Names> cells;
        for (const std::string& variant : distinct(all, &AcrossRow::variant)) {
            Names& line = cells.emplace_back(Names{variant});
            for (const std::string& group : groups) {
                const Rows rows = rows_at(machine, cost, group);
                const auto row = std::ranges::find(rows, variant, &AcrossRow::variant);
                const bool is_ahead =
                    row != rows.end() && !(*row)->standing.empty() && (*row)->standing != standing::behind;
                line.push_back(row == rows.end() ? ""
                                                 : (is_ahead ? "not behind: " : "") +
                                                       measured((*row)->ratio, (*row)->low, (*row)->high) + "; " +
                                                       number((*row)->median));
            }
        }
        return "\nIn each group (scenes): error / " + base_ +
               ", geometric mean with its interval, then the median. Not behind: best, undecided beside the least, or "
               "within the margin of it.\n\n" +
               markdown_table(head, cells);
    }

    /// Rows of across.csv as a table; `last`: the head of its last column, `of_last`: what stands there.
    std::string ranking(const std::string& what, const Rows& rows, const std::string& last,
                        const Names& of_last) const {
        const auto chance = [](const Number& share) { return share ? printed("%.2f", *share) : ""; };
        std::vector<Names> cells;
        for (size_t i = 0; i < rows.size(); ++i) {
            const AcrossRow& row = *rows[i];
            const std::string rank =
                row.rank ? message_text(*row.rank, " (", *row.rank_low, " to ", *row.rank_high, ")") : "";
            cells.push_back({row.label, rank, measured(row.ratio, row.low, row.high),
                             measured(row.median, row.median_low, row.median_high),
                             measured(row.over_best, row.over_best_low, row.over_best_high), number(row.p_holm),
                             chance(row.chance_first), chance(row.chance_near),
                             measured(row.scenes_needed, row.scenes_needed_low, row.scenes_needed_high),
                             std::to_string(row.wins), std::to_string(row.shared), of_last[i]});
        }
        return markdown_table({what, "rank (without any one scene)", "error / " + base_, "median of it",
                               "error / first's", "p (adjusted)", "probability to be first", "within 10 %",
                               "scenes that 10 % need", "shots won", "shots shared", last},
                              cells);
    }

    std::string first_sentence(const Rows& rows) const {
        const AcrossRow* first = first_of(rows);
        if (!first || (first->ratio == 1 && first->label == base_label_))
            return message_text("No technique fits in all ", rows.front()->of_scenes, " scenes") +
                   (first ? " with less error than " + base_ + "." : ".");
        Names beaten, near, undecided;
        for (const AcrossRow* row : rows)
            if (row->rank && row != first)
                (row->standing == standing::behind       ? beaten
                 : row->standing == standing::equivalent ? near
                                                         : undecided)
                    .push_back(row->label);
        std::string text = message_text("**", markdown_text(first->label), "** has the least error, ",
                                        measured(first->ratio, first->low, first->high), " of that of ", base_,
                                        " (geometric mean, ", first->scenes, " scenes)");
        if (beaten.empty() && near.empty() && undecided.empty()) return text + "; nothing else fits in all of them.";
        text += ". ";
        if (!first->low) return text + message_text("Of other scenes ", first->scenes, " scenes say nothing.");
        if (first->standing == standing::best)
            return text + "In scenes like these the rest is behind for certain (adjusted for all comparisons, 0.05).";
        text += "In scenes like these the least on average is " + chances(rows, &AcrossRow::chance_first) +
                " (probability); within 10 % of the least " + chances(rows, &AcrossRow::chance_near) + ".";
        if (!near.empty()) text += " Within the margin of the first for certain: " + markdown_text(listed(near)) + ".";
        if (!undecided.empty()) text += " Undecided beside the first: " + markdown_text(listed(undecided)) + ".";
        if (!beaten.empty()) text += " Behind for certain: " + markdown_text(listed(beaten)) + ".";
        return text;
    }

    static std::string chances(Rows rows, Number AcrossRow::*chance) {
        std::erase_if(rows, [&](const AcrossRow* row) { return !(row->*chance); });
        std::ranges::stable_sort(rows, std::greater(), [&](const AcrossRow* row) { return *(row->*chance); });
        Names named;
        for (size_t i = 0; i < rows.size(); ++i)
            if (i == 0 || (i < 3 && *(rows[i]->*chance) >= 0.02))
                named.push_back(markdown_text(rows[i]->label) + " with " + printed("%.2f", *(rows[i]->*chance)));
        return listed(named);
    }

    std::string whole() const {
        const Rows rows = rows_at("", {});
        if (rows.empty()) return "";
        Names scenes;
        for (const AcrossRow* row : rows) scenes.push_back(std::to_string(row->scenes));
        return "## Least error at any cost\n\n" + first_sentence(rows) + "\n\n" +
               ranking("point", rows, "scenes", scenes);
    }

    std::string shots() const {
        std::string text;
        if (!machines_.empty())
            text =
                "## Each shot\n\nA technique is its variant: all of its points make its front. Curves between two of "
                "them are interpolated (logarithmic): nothing was run there.\n\n";
        for (const auto& shot : between_.shots)
            if (!shot->curves.empty())
                text += "### " + markdown_text(shot->label) + "\n\n" + front_sentence(*shot) + "\n\n" +
                        costs_table(*shot) + errors_table(*shot);
        return text;
    }

    std::string front_sentence(const MeasuredShot& shot) const {
        std::vector<const FrontRow*> rows;
        for (const MeasuredPoint& p : shot.points)
            if (p.row.cost) rows.push_back(&p.row);
        std::ranges::stable_sort(rows, {}, [](const FrontRow* row) { return *row->cost; });
        Names sure, maybe;
        size_t beaten = 0;
        for (const FrontRow* row : rows) {
            const std::string label = markdown_text(row->label);
            if (row->verdict == "front")
                sure.push_back(label + " (" + measured(row->cost, row->cost_low, row->cost_high) + " " + unit_ + ", " +
                               measured(row->error, row->error_low, row->error_high) + ")");
            if (row->verdict == "undecided") maybe.push_back(label);
            beaten += row->verdict == "dominated";
        }
        std::string text = sure.empty() ? "No point is certainly on the front."
                                        : "Certainly on the front: " + joined(sure, ", ") + ".";
        if (!maybe.empty()) text += " Undecided: " + joined(maybe, ", ") + ".";
        return beaten > 0 ? message_text(text, " ", beaten, " points are dominated.") : text;
    }

    /// The curves of more than the baseline alone.
    std::vector<std::pair<std::string, const Curve*>> curves_of(const MeasuredShot& shot) const {
        std::vector<std::pair<std::string, const Curve*>> curves;
        for (const auto& [variant, curve] : shot.curves)
            if (curve.points().size() > 1 || curve.points().front()->name() != found_.baseline)
                curves.emplace_back(variant, &curve);
        return curves;
    }

    std::string costs_table(const MeasuredShot& shot) const {
        Names head = {"technique", "measured at (" + unit_ + ")"};
        for (const double cost : costs_) head.push_back("error at " + number(cost) + " " + unit_);
        std::vector<Names> cells;
        for (const auto& [variant, curve] : curves_of(shot)) {
            Names& line = cells.emplace_back(Names{variant, number(curve->start()) + " to " + number(curve->end())});
            for (const ErrorAtCostRow& row : between_.error_at_cost)
                if (row.shot == shot.name && row.variant == variant) line.push_back(error_text(row));
        }
        return markdown_table(head, cells);
    }

    static std::string error_text(const ErrorAtCostRow& row) {
        if (!row.error && row.point.empty())
            return "below " + number(row.start) + " no point was measured" + (row.fits == "maybe" ? " (may fit)" : "");
        const std::string text = row.status == "past end"
                                     ? bound(row.error, row.high) + ", reached at " + number(row.end)
                                     : measured(row.error, row.low, row.high);
        return text + (row.fits == "surely" ? "" : " (may not fit)");
    }

    std::string errors_table(const MeasuredShot& shot) const {
        if (!shot.divisor) return "";
        Names head = {"technique"};
        for (const double factor : factors_)
            head.push_back(unit_ + " to " + number(factor) + " of " + base_ + "'s error (" +
                           number(factor * *shot.divisor) + ")");
        std::vector<Names> cells;
        for (const auto& [variant, curve] : curves_of(shot)) {
            Names& line = cells.emplace_back(Names{variant});
            for (const CostToErrorRow& row : between_.cost_to_error)
                if (row.shot == shot.name && row.variant == variant) line.push_back(cost_text(row));
        }
        return markdown_table(head, cells);
    }

    static std::string cost_text(const CostToErrorRow& row) {
        if (row.status == "not reached")
            return std::string(*row.share_that_reach < 0.025 ? "not" : "perhaps not") + " reached by " +
                   number(row.end);
        if (row.status == "before start") return bound(row.cost, row.high) + ", its cheapest";
        return row.low ? measured(row.cost, row.low, row.high) : bound(row.cost, row.high);
    }

    std::string floors() const {
        if (between_.fits.empty() && between_.limits.empty()) return "";
        return "## What more " + (is_timed() ? "time" : unit_) + " cannot improve\n\n" + limits() + fits();
    }

    std::string limits() const {
        const std::string rung = rungs.front();
        std::vector<Names> cells;
        size_t clear = 0, above = 0;
        for (const LimitRow& row : between_.limits) {
            if (row.rung != rung) continue;
            clear += row.over_rung_high.has_value();
            above += row.over_rung_high && *row.over_rung_low > 1;
            cells.push_back({shot_of(row.shot).label, row.label, number(row.cost),
                             measured(row.error, row.error_low, row.error_high),
                             measured(row.rung_error, row.rung_low, row.rung_high),
                             measured(row.over_rung, row.over_rung_low, row.over_rung_high)});
        }
        if (cells.empty()) return "";
        std::string text =
            "`" + rung +
            "` is the lower bound for any single-frame technique: all that the image shows is found, and "
            "elsewhere the environment is seen. Only what earlier frames showed, or luck, goes below it. ";
        if (clear > 0)
            text +=
                message_text("The least error of all points is significantly above it in ", above, " of the ", clear,
                             " shots in which it is significantly above 0: there better techniques are possible.");
        return text + "\n\n" +
               markdown_table({"shot", "least error", unit_, "its error", "`" + rung + "`", "error / `" + rung + "`"},
                              cells);
    }

    std::string fits() const {
        if (between_.fits.empty()) return "";
        const auto axis_of = [](const FitRow& row) {
            return row.variant + (row.fixed.empty() ? "" : " " + row.fixed) + " along " + row.parameter;
        };
        std::string text =
            "error = floor + a cost^-b along each axis of quality: the floor is a lower bound along that axis alone, "
            "at "
            "any cost.\n\n";
        std::vector<Names> cells;
        for (const std::string& axis : distinct(between_.fits, axis_of)) {
            size_t of_axis = 0, floors = 0, above = 0;
            std::string rung;  // that of the first floor above it
            for (const FitRow& row : between_.fits) {
                if (axis_of(row) != axis) continue;
                const bool has_floor = row.floor_low.value_or(0) > 0;
                const bool is_above = has_floor && row.floor_over_rung_low.value_or(0) > 1;
                if (is_above && above == 0) rung = row.rung;
                ++of_axis, floors += has_floor, above += is_above;
                cells.push_back({axis, shot_of(row.shot).label, std::to_string(row.points),
                                 number(row.cost_from) + " to " + number(row.cost_to),
                                 measured(row.floor, row.floor_low, row.floor_high),
                                 measured(row.floor_over_rung, row.floor_over_rung_low, row.floor_over_rung_high),
                                 measured(row.b, row.b_low, row.b_high), number(row.misfit), row.status});
            }
            text += message_text("- ", markdown_text(axis), ": a floor is significantly above 0 in ", floors, " of ",
                                 of_axis, " shots");
            if (above > 0) text += message_text(", and above ", markdown_code(rung), " in ", above);
            text += ".\n";
        }
        return text + "\n" +
               markdown_table({"axis", "shot", "points", unit_, "floor", "floor / rung", "b", "misfit", "status"},
                              cells);
    }

    using ChangeKey = std::tuple<std::string, std::string, std::string, std::string>;
    static ChangeKey change_key(const ChangeRow* row) {
        return {row->variant, row->point, row->against_variant, row->against_point};
    }

    std::string stages() const {
        if (found_.changes.empty()) return "";
        std::string text =
            "## What each change gains and costs\n\nPoints that differ in one parameter. A stage that is switched off "
            "may "
            "*save cost* and add error. The last column is the cost of each percent of error.\n\n";
        for (const std::string& machine : distinct(found_.changes, &ChangeRow::machine)) {
            std::vector<const ChangeRow*> pooled, single;
            for (const ChangeRow& row : found_.changes)
                if (row.machine == machine && row.shot.empty() && row.error_low) pooled.push_back(&row);
            for (const ChangeRow& row : found_.changes)
                if (row.machine == machine && !row.shot.empty() &&
                    std::ranges::count(pooled, change_key(&row), change_key) == 0)
                    single.push_back(&row);
            text += "On " + markdown_text(machine) +
                    (pooled.empty() ? "" : ", over scenes: geometric mean of the ratios of errors, mean of the costs") +
                    ":\n\n" + stage_table("scenes", pooled);
            if (!single.empty())
                text += "In each shot, since three scenes or fewer are too few for an interval:\n\n" +
                        stage_table("shot", single);
        }
        return text;
    }

    std::string stage_table(const std::string& first, std::vector<const ChangeRow*> rows) const {
        std::ranges::stable_sort(rows, {}, change_key);
        const auto percent = [](const Number& ratio) { return ratio ? Number(100 * (*ratio - 1)) : Number(); };
        std::vector<Names> cells;
        for (const ChangeRow* row : rows)
            cells.push_back({label_of({row->against_variant, row->against_point}) + ": " + row->change,
                             first == "shot" ? shot_of(row->shot).label : std::to_string(row->scenes),
                             measured(percent(row->error_ratio), percent(row->error_low), percent(row->error_high)),
                             measured(row->cost, row->cost_low, row->cost_high), row->verdict,
                             measured(row->cost_per_percent, row->cost_per_percent_low, row->cost_per_percent_high)});
        if (cells.empty()) return "";
        return markdown_table({"change", first, "% more error", unit_ + " more", "verdict", unit_ + " per % of error"},
                              cells);
    }

    const json& manifest_;
    const PrimaryComparisons& error_;
    const Tradeoff& found_;
    const BetweenPoints& between_;
    const std::vector<double>&costs_, &factors_;
    std::map<PointName, std::string> labels_;
    std::string unit_, base_label_, base_;
    Names machines_;
};

}  // namespace

std::string tradeoff_answers(const StudyTables& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             const BetweenPoints& between, const std::vector<double>& costs,
                             const std::vector<double>& factors) {
    return Answers(tables, error, found, between, costs, factors).text();
}
