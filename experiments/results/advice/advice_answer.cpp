#include "experiments/results/advice/advice_answer.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "core/number_text.h"
#include "core/shown_text.h"
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/tradeoff/answer_context.h"
#include "experiments/results/verdicts/standings.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace {

using nlohmann::json;
using AdviceRows = std::vector<const AdviceRow*>;

constexpr const char* page_of_advice = "experiments/docs/advise.md";

/// The rows of one chip, place, movement and budget.
struct AdviceOfQuestion {
    AdviceRows rows;

    const AdviceRow& any() const { return *rows.front(); }
    /// The row that errs least; null if nothing fits, or if nothing that fits improves on no reflections.
    const AdviceRow* first() const {
        const auto least = std::ranges::find_if(rows, [](const AdviceRow* row) { return row->rank == 1.0; });
        return least == rows.end() || *(*least)->ratio >= 1 ? nullptr : *least;
    }
    const AdviceRow* second() const {
        const auto next = std::ranges::find_if(rows, [](const AdviceRow* row) { return row->rank == 2.0; });
        return next == rows.end() ? nullptr : *next;
    }
};

std::string kind_text(const AdviceRow& row) { return row.place + ", " + row.movement; }
std::string name_text(const AdviceRow& row) { return shown_text(row.label); }
std::string ratio_text(const AdviceRow& row) { return measured(row.ratio, row.low, row.high); }
std::string chance_text(const AdviceRow& row) { return row.chance_first ? probability_text(*row.chance_first) : "-"; }
std::string budget_text(double ms) { return number_text(ms) + " ms"; }

std::optional<double> in_ms(const std::optional<double>& us) { return us ? std::optional(*us / 1000) : std::nullopt; }
std::string time_text(const AdviceRow& row) { return measured(in_ms(row.us), in_ms(row.us_low), in_ms(row.us_high)); }

const char* surface_text(const std::string& name) {
    return std::ranges::find(advised_surfaces, name, [](const AdvisedSurface& s) { return std::string(s.name); })
        ->meaning;
}

/// "room" asks for "rooms", too.
bool is_place(const std::string& asked, const std::string& place) { return asked == place || asked + "s" == place; }

/// Fails if no row has the asked value; `how`: what to run to add it.
template <class IsAsked>
void require_asked(const AdviceRows& rows, std::string AdviceRow::*member, const std::string& asked, IsAsked is_asked,
                   const std::string& what, const std::string& how) {
    const Names known = distinct(rows, [&](const AdviceRow* row) { return row->*member; });
    if (asked.empty() || std::ranges::any_of(known, is_asked)) return;
    Names shown;
    for (const std::string& name : known) {
        const auto chip = chip_rates(name);
        shown.push_back(name + (chip ? " (" + chip->product + ")" : ""));
    }
    fail("the table has no ", what, " '", shortened(asked), "'; it has ", joined(shown), ". To add one, ", how, " (",
         page_of_advice, ")");
}

/// All rows of the chip, place, movement and surface that are asked for, at any budget.
AdviceRows rows_asked_for(const Advice& advice, const AdviceQuestion& question) {
    AdviceRows rows;
    for (const AdviceRow& row : advice.rows) rows.push_back(&row);
    const auto narrow = [&](std::string AdviceRow::*member, const std::string& asked, const std::string& what,
                            const std::string& how) {
        const auto is_asked = [&](const std::string& value) { return is_place(asked, value); };
        require_asked(rows, member, asked, is_asked, what, how);
        std::erase_if(rows, [&](const AdviceRow* row) { return !asked.empty() && !is_asked(row->*member); });
    };
    narrow(&AdviceRow::chip, question.chip, "chip",
           "name it in \"gpu_compilers\" of the study of costs, run it, and make the table again");
    narrow(&AdviceRow::place, question.place, "place",
           "run both studies with shots of that group, and make the table again");
    narrow(&AdviceRow::movement, question.movement, "movement",
           "run a study of errors with shots of that group, and make the table again");
    narrow(&AdviceRow::surface, question.surface, "surface",
           "name its mask in \"masks\" of the studies of errors, run them, and make the table again");
    return rows;
}

std::vector<double> budgets_of(const AdviceRows& rows) {
    std::set<double> budgets;
    for (const AdviceRow* row : rows)
        if (row->ms) budgets.insert(*row->ms);
    if (budgets.empty()) fail("the table has no budgets; ", page_of_advice, " says how to make the table");
    return {budgets.begin(), budgets.end()};
}

/// The largest budget of the table that is not above the asked one.
double budget_for(const AdviceRows& rows, double asked) {
    const std::vector<double> budgets = budgets_of(rows);
    if (asked >= budgets.front()) return *std::prev(std::ranges::upper_bound(budgets, asked));
    const AdviceRow* cheapest = nullptr;
    for (const AdviceRow* row : rows)
        if (row->us && row->technique != "none" && (!cheapest || *row->us < *cheapest->us)) cheapest = row;
    const std::string least = cheapest ? "; the cheapest point, " + name_text(*cheapest) + ", takes " +
                                             time_text(*cheapest) + " ms in " + cheapest->place
                                       : "";
    fail(cheapest && *cheapest->us > 1000 * asked ? "nothing fits within " : "nothing was studied for ",
         budget_text(asked), " on ", rows.front()->chip, least, ". Ask for ", budget_text(budgets.front()), " or more");
}

std::vector<AdviceOfQuestion> answers_of(const Advice& advice, const AdviceQuestion& question) {
    const AdviceRows rows = rows_asked_for(advice, question);
    std::optional<double> budget;
    if (question.ms) budget = budget_for(rows, *question.ms);
    using Key = std::tuple<std::string, std::string, std::string, double>;
    std::vector<std::pair<Key, AdviceOfQuestion>> answers;
    for (const AdviceRow* row : rows) {
        if (!row->ms || (budget && *row->ms != *budget)) continue;
        const Key key(row->chip, row->place, row->movement, *row->ms);
        auto own = std::ranges::find(answers, key, [](const auto& answer) { return answer.first; });
        if (own == answers.end()) own = answers.insert(own, {key, {}});
        own->second.rows.push_back(row);
    }
    std::ranges::stable_sort(answers, {}, [](const auto& answer) { return answer.first; });
    std::vector<AdviceOfQuestion> found;
    for (auto& [key, answer] : answers) found.push_back(std::move(answer));
    return found;
}

/// "  Certainly errs more: A 0.5 [0.4, 0.6]; B ..."; "" for no names.
std::string line_of(const std::string& head, const Names& names) {
    return names.empty() ? "" : "  " + head + ": " + joined(names, "; ") + "\n";
}

std::string beside_first(const AdviceOfQuestion& answer, const AdviceRow* first) {
    Names near, equivalent, undecided, behind, absent;
    for (const AdviceRow* row : answer.rows) {
        if (row == first || row->technique == "none") continue;
        const std::string text = name_text(*row) + " " + ratio_text(*row), time = time_text(*row) + " ms";
        if (row->reason == above_budget)
            absent.push_back(name_text(*row) + " takes " + time);
        else if (!row->reason.empty())
            absent.push_back(shown_text(row->technique + ": " + row->reason));
        else if (row->standing == standing::behind)
            behind.push_back(text);
        else if (row->standing.empty())
            undecided.push_back(text + ", " + time);
        else
            (row->standing == standing::equivalent ? equivalent : near)
                .push_back(text + ", probability " + chance_text(*row) + ", " + time);
    }
    return line_of("May be as good or better (no significant difference)", near) +
           line_of("Certainly about as good (within the margin of the studies)", equivalent) +
           line_of("Not judged, because there are too few scenes", undecided) + line_of("Certainly worse", behind) +
           line_of("Does not fit, by its cheapest point", absent);
}

std::string one_answer(const AdviceOfQuestion& answer, const json& points) {
    const AdviceRow &any = answer.any(), *first = answer.first();
    std::string text = shown_text(any.chip + ", " + budget_text(*any.ms) + ", " + kind_text(any) + ", ") +
                       surface_text(any.surface) + "\n";
    if (!first) {
        const bool some_fit =
            std::ranges::any_of(answer.rows, [](const AdviceRow* row) { return row->reason.empty(); });
        return text +
               (some_fit ? "  Nothing that fits errs less than an image without reflections.\n" : "  Nothing fits.\n") +
               beside_first(answer, nullptr);
    }
    text += "  Use " + name_text(*first) +
            (first->standing == standing::best ? ", which certainly errs least.\n"
                                               : ", which errs least, but not certainly.\n");
    text += "  Parameters that differ from the defaults: " + shown_text(points[first->technique][first->point].dump()) +
            "\n";
    text += "  Visible error (FLIP): " + ratio_text(*first) + " times the error without reflections, over " +
            std::to_string(first->scenes) + " of " + counted(first->of_scenes, "scene") + "\n";
    if (first->chance_first)
        text += "  Probability of the least mean error in scenes like these: " + chance_text(*first) + "\n";
    text += "  Estimated time: " + time_text(*first) + " ms, mean over " + counted(first->places, "place") +
            (first->us_low ? "\n" : ", which are too few for an interval\n");
    return text + beside_first(answer, first);
}

std::string study_text(const json& study) {
    const Names sizes = names_of(study["sizes"], [](const json& size) { return size.get<std::string>(); });
    return shown_text(study["config"].get<std::string>() + " (" + joined(sizes, " and ") + ", commit " +
                      study["commit"].get<std::string>().substr(0, 40) + ")");
}

std::string what_it_rests_on(const Advice& advice, const std::string& chip) {
    std::string text = "This rests on:\n";
    for (const json& study : advice.sources["errors"]) text += "  Errors: " + study_text(study) + "\n";
    for (const json& study : advice.sources["costs"]) {
        std::string compilers;
        for (const auto& [of_chip, driver] : study["compilers"].items())
            if (chip.empty() || chip == of_chip)
                compilers += ", " + shown_text(of_chip + ": " + driver.get<std::string>());
        if (!compilers.empty()) text += "  Times: " + study_text(study) + compilers + "\n";
    }
    return text + "  Times are estimates, and no GPU ran anything: " + model_range_text() +
           ".\n  Brackets hold 95 % intervals for scenes and places like these, without the error of the model.\n";
}

/// Says if another budget than the asked one is answered.
std::string about_budget(const Advice& advice, const AdviceQuestion& question) {
    const AdviceRows rows = rows_asked_for(advice, question);
    const double used = budget_for(rows, *question.ms);
    if (used == *question.ms) return "";
    const bool is_last = used == budgets_of(rows).back();
    return "The table has no budget of " + budget_text(*question.ms) + ". " +
           (is_last ? "Nothing dearer than " + budget_text(used) + " was studied; the answer is for this budget."
                    : "The answer is for the nearest lower one, " + budget_text(used) + ".") +
           "\n\n";
}

std::string table_text(const std::vector<Names>& lines) {
    std::vector<size_t> widths(lines.front().size());
    for (const Names& line : lines)
        for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    std::string text;
    for (const Names& line : lines) {
        for (size_t i = 0; i < line.size(); ++i)
            text += line[i] + (i + 1 < line.size() ? std::string(widths[i] - line[i].size() + 2, ' ') : "");
        text += "\n";
    }
    return text;
}

std::string table_of_answers(const std::vector<AdviceOfQuestion>& answers, const std::string& surface) {
    std::vector<Names> lines = {
        {"chip", "budget", "kind of picture", "least error", "FLIP / none", "probability", "ms", "second"}};
    for (const AdviceOfQuestion& answer : answers) {
        const AdviceRow &any = answer.any(), *first = answer.first(), *second = answer.second();
        Names& line = lines.emplace_back(Names{shown_text(any.chip), budget_text(*any.ms), shown_text(kind_text(any))});
        if (first)
            for (const std::string& cell :
                 {name_text(*first), ratio_text(*first), chance_text(*first), time_text(*first)})
                line.push_back(cell);
        else
            line.insert(line.end(), {"nothing that helps fits", "", "", ""});
        line.push_back(!first || !second ? ""
                                         : name_text(*second) + " " + ratio_text(*second) +
                                               (second->standing == standing::behind ? " (certainly worse)" : ""));
    }
    return std::string("Techniques of least error over ") + surface_text(surface) + ":\n\n" + table_text(lines);
}

}  // namespace

std::string advice_answer(const Advice& advice, const AdviceQuestion& question) {
    const std::vector<AdviceOfQuestion> answers = answers_of(advice, question);
    std::string text = question.ms ? about_budget(advice, question) : "";
    if (!question.is_whole())
        return text + table_of_answers(answers, question.surface) + "\n" + what_it_rests_on(advice, question.chip) +
               "Add --chip and --ms for parameters and alternatives.\n";
    for (const AdviceOfQuestion& answer : answers) text += one_answer(answer, advice.sources["points"]) + "\n";
    return text + what_it_rests_on(advice, question.chip) +
           "Add --json - to print the parameters as a study's config takes them. " + page_of_advice +
           " says how to make the table again.\n";
}

json advised_points(const Advice& advice, const AdviceQuestion& question) {
    std::map<std::string, std::map<std::string, const AdviceRow*>> points;  // by technique and point
    for (const AdviceOfQuestion& answer : answers_of(advice, question))
        if (const AdviceRow* first = answer.first()) points[first->technique][first->point] = first;
    if (points.empty()) fail("nothing that fits errs less than an image without reflections; ask for a larger budget");
    json entries = json::array();
    for (const auto& [technique, of_technique] : points)
        for (const auto& [point, row] : of_technique) {
            json& entry = entries.emplace_back(json{{"technique", technique}});
            const json& parameters = advice.sources["points"][technique][point];
            if (of_technique.size() == 1 && !parameters.empty()) entry["parameters"] = parameters;
            // A study distinguishes points of a technique by what is swept.
            if (of_technique.size() > 1)
                for (const auto& [name, value] : parameters.items()) entry["sweep"][name] = {value};
        }
    return entries;
}
