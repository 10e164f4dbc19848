#include "experiments/results/tradeoff/answer_context.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "experiments/results/files/markdown.h"
#include "experiments/results/verdicts/standings.h"

namespace {

using Number = std::optional<double>;

using Rows = std::vector<const AcrossRow*>;

/// Rankings over scenes, at each cost and at any.
struct AtCosts : AnswerContext {
    std::string at_costs() const {
        std::string text;
        for (const std::string& machine : machines) {
            const bool is_nameless = machine.starts_with("not timed");  // frozen points need no times
            const std::string where = is_nameless
                                          ? "N" + machine.substr(1)
                                          : (found.costs_from.empty() ? "Machine: " : "Images with errors: ") + machine;
            const std::string who = who_stands();
            text +=
                message_text("## Which technique at which ", is_timed() ? "time" : "cost", "\n\n", markdown_text(where),
                             ". The tables compare means over scenes.", who.empty() ? "" : " ", who, "\n\n");
            std::vector<Names> cells;
            for (const double cost : costs) cells.push_back(short_answer(machine, cost));
            text += markdown_table({unit, "least error", "error / " + base, "not certainly worse"}, cells);
            for (const double cost : costs) text += at_cost(machine, cost);
        }
        return text;
    }

    std::string who_stands() const {
        bool some = false, others = false;
        for (const ChosenPoint& c : found.chosen)
            if (!c.point.empty()) (c.chosen_on == "frozen" ? some : others) = true;
        if (!some) return "";
        return others ? "Some points were chosen on the scenes of another study (`frozen`), the others on these scenes."
                      : "Each technique is judged by the point that was chosen on the scenes of another study "
                        "(`frozen`).";
    }

    /// `cost`: none: of points, whatever they cost.
    Rows rows_at(const std::string& machine, const Number& cost, const std::string& group = "") const {
        Rows rows;
        const std::string text = cost ? number_text(*cost, 9) : "";
        for (const AcrossRow& row : found.across)
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
        if (!first || first->label == base_label)
            return {shown_number(cost), "no technique fits in all scenes", "", ""};
        Names near;
        for (const AcrossRow* row : rows)
            if (row->rank && row != first && row->standing != standing::behind)
                near.push_back(row->technique == "none" ? "no reflections (" + row->label + ")" : row->label);
        return {shown_number(cost), first->label, measured(first->ratio, first->low, first->high), joined(near, ", ")};
    }

    std::string at_cost(const std::string& machine, double cost) const {
        const Rows rows = rows_at(machine, cost);
        const std::string title = "### " + shown_number(cost) + " " + unit + "\n\n";
        if (rows.empty()) return title + "No point fits in any scene.\n\n";
        const size_t scenes = rows.front()->of_scenes;
        std::string text = title + first_sentence(rows) + "\n" + point_sentence(machine, rows, cost);
        Names partly, fitting, absent;
        for (const AcrossRow* row : rows) {
            if (!row->rank && row->scenes < scenes)
                partly.push_back(message_text(markdown_text(row->label), " (", row->scenes, " of ", scenes,
                                              " scenes, where its error is ", measured(row->ratio, row->low, row->high),
                                              " times the error of ", base, ")"));
            fitting.push_back(row->scenes_that_fit ? message_text(*row->scenes_that_fit, " of ", scenes) : "");
        }
        if (!partly.empty())
            text += "Not ranked, because they do not fit in all scenes: " + joined(partly, "; ") + ".\n";
        for (const auto& shot : between.shots)
            for (const auto& [technique, curve] : shot->curves)
                if (std::ranges::count(absent, technique) == 0 &&
                    std::ranges::count(rows, technique, &AcrossRow::technique) == 0)
                    absent.push_back(technique);
        std::ranges::sort(absent);
        if (!absent.empty())
            text += "No point fits in any scene: " + markdown_text(listed(absent, most_listed)) + ".\n";
        return text + "\n" + ranking("technique", rows, "scenes where it surely fits", fitting) +
               groups_at(machine, cost, rows);
    }

    /// The first technique's point, and the entry of a config that makes this point. The errors above are of points
    /// that were chosen without the scene that judges them; this one is chosen on all scenes.
    std::string point_sentence(const std::string& machine, const Rows& rows, double cost) const {
        const AcrossRow* first = first_of(rows);
        if (!first) return "";
        const auto frozen = std::ranges::find_if(found.chosen, [&](const ChosenPoint& c) {
            return c.technique == first->technique && c.cost == cost && c.chosen_on == "frozen";
        });
        if (frozen != found.chosen.end()) return named("Its frozen point is ", {first->technique, frozen->point});
        for (const FrozenPoint& p : found.to_freeze)
            if (p.machine == machine && p.technique == first->technique && p.cost == cost)
                return named("Chosen on all of these scenes together, its best point within this cost is ",
                             {p.technique, p.point});
        return "";
    }

    std::string named(const std::string& lead, const PointName& point) const {
        std::string text = lead + markdown_text(label_of(point));
        for (const nlohmann::json& of : manifest.at("techniques")) {
            if (of.at("technique") != point.first || of.at("point") != point.second || !of.contains("entry")) continue;
            const std::string entry = of["entry"].dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
            const bool ends_code = entry.find('`') != std::string::npos;
            text += ", in a config " + (ends_code ? markdown_text(entry) : "`" + entry + "`");
        }
        return text + ".\n";
    }

    /// Each technique in each group of shots, where the study has several.
    std::string groups_at(const std::string& machine, double cost, const Rows& all) const {
        Names groups = distinct(found.across, &AcrossRow::group), head = {"technique"};
        std::erase(groups, "");
        if (groups.empty()) return "";
        for (const std::string& group : groups) {
            size_t scenes = 0;
            for (const AcrossRow* row : rows_at(machine, cost, group)) scenes = std::max(scenes, row->scenes);
            head.push_back(message_text(group, " (", scenes, ")"));
        }
        std::vector<Names> cells;
        for (const std::string& technique : distinct(all, &AcrossRow::technique)) {
            Names& line = cells.emplace_back(Names{technique});
            for (const std::string& group : groups) {
                const Rows rows = rows_at(machine, cost, group);
                const auto row = std::ranges::find(rows, technique, &AcrossRow::technique);
                const bool is_ahead =
                    row != rows.end() && !(*row)->standing.empty() && (*row)->standing != standing::behind;
                line.push_back(row == rows.end() ? ""
                                                 : (is_ahead ? "not behind: " : "") +
                                                       measured((*row)->ratio, (*row)->low, (*row)->high) + "; " +
                                                       shown_number((*row)->median));
            }
        }
        return "\nEach group of scenes, with the number of scenes. A cell holds error / " + base +
               ": the geometric mean with its interval, then the median. \"not behind\" marks techniques that are not "
               "certainly worse than the best of the group.\n\n" +
               markdown_table(head, cells);
    }

    /// Rows of across.csv as a table; `last`: the head of its last column, `of_last`: what stands there.
    std::string ranking(const std::string& what, const Rows& rows, const std::string& last,
                        const Names& of_last) const {
        const auto chance = [](const Number& share) { return share ? probability_text(*share) : ""; };
        std::vector<Names> cells;
        for (size_t i = 0; i < rows.size(); ++i) {
            const AcrossRow& row = *rows[i];
            const std::string rank =
                row.rank ? message_text(*row.rank, " (", *row.rank_low, " to ", *row.rank_high, ")") : "";
            cells.push_back({row.label, rank, measured(row.ratio, row.low, row.high),
                             measured(row.median, row.median_low, row.median_high),
                             measured(row.over_best, row.over_best_low, row.over_best_high), shown_number(row.p_holm),
                             chance(row.chance_first), chance(row.chance_near),
                             measured(row.scenes_needed, row.scenes_needed_low, row.scenes_needed_high),
                             std::to_string(row.wins), std::to_string(row.shared), of_last[i]});
        }
        return markdown_table(
            {what, "rank (with any one scene left out)", "error / " + base, "median", "error / error of the first",
             "p (adjusted)", "probability to be first", "probability within 10 %", "scenes needed to see 10 %",
             "shots won", "shots shared", last},
            cells);
    }

    std::string first_sentence(const Rows& rows) const {
        const AcrossRow* first = first_of(rows);
        if (!first || (first->ratio == 1 && first->label == base_label))
            return first ? message_text("No technique that fits in all ", rows.front()->of_scenes,
                                        " scenes has less error than ", base, ".")
                         : message_text("No technique fits in all ", rows.front()->of_scenes, " scenes.");
        Names beaten, near, undecided;
        for (const AcrossRow* row : rows)
            if (row->rank && row != first)
                (row->standing == standing::behind       ? beaten
                 : row->standing == standing::equivalent ? near
                                                         : undecided)
                    .push_back(row->label);
        std::string text = message_text("**", markdown_text(first->label), "** has the least error, ",
                                        measured(first->ratio, first->low, first->high), " times the error of ", base,
                                        " (geometric mean, ", counted(first->scenes, "scene"), "). ");
        if (beaten.empty() && near.empty() && undecided.empty())
            return text + "Nothing else fits in all of these scenes.";
        if (!first->low)
            return text + message_text(counted(first->scenes, "scene"), first->scenes == 1 ? " says" : " say",
                                       " nothing about other scenes.");
        if (first->standing == standing::best)
            return text +
                   "In scenes like these all others are certainly worse (p < 0.05, adjusted for all comparisons).";
        text += "Probability of the least mean error in scenes like these: " + chances(rows, &AcrossRow::chance_first) +
                ". Probability of a mean error within 10 % of the least: " + chances(rows, &AcrossRow::chance_near) +
                ".";
        if (!near.empty())
            text += " Certainly within the margin of the first: " + markdown_text(listed(near, most_listed)) + ".";
        if (!undecided.empty())
            text += " It is undecided whether the first errs less than " +
                    markdown_text(listed(undecided, most_listed)) + ".";
        if (!beaten.empty()) text += " Certainly worse: " + markdown_text(listed(beaten, most_listed)) + ".";
        return text;
    }

    static std::string chances(Rows rows, Number AcrossRow::*chance) {
        std::erase_if(rows, [&](const AcrossRow* row) { return !(row->*chance); });
        std::ranges::stable_sort(rows, std::greater(), [&](const AcrossRow* row) { return *(row->*chance); });
        Names named;
        for (size_t i = 0; i < rows.size(); ++i)
            if (i == 0 || (i < 3 && *(rows[i]->*chance) >= 0.02))
                named.push_back(markdown_text(rows[i]->label) + " " + probability_text(*(rows[i]->*chance)));
        return listed(named, most_listed);
    }

    std::string whole() const {
        const Rows rows = rows_at("", {});
        if (rows.empty()) return "";
        Names scenes;
        for (const AcrossRow* row : rows) scenes.push_back(std::to_string(row->scenes));
        return "## Least error at any cost\n\n" + first_sentence(rows) + "\n\n" +
               ranking("point", rows, "scenes", scenes);
    }
};

}  // namespace

std::string answers_at_costs(const AnswerContext& context) {
    const AtCosts answers{context};
    return answers.at_costs() + answers.whole();
}
