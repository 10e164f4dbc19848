// ssrlab diff: which numbers changed from one results folder to another.
#include "experiments/cli/diff_command.h"
#include "core/error.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/report/diff_page.h"
#include "experiments/results/verdicts/study_diff.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>

namespace {

constexpr size_t most_named = 12;  // changes, unless all are asked for

void print_techniques(const std::vector<NumberChange>& errors) {
    const char* verdicts[] = {change::equal, change::equivalent, change::undecided, change::changed,
                              change::not_judged};
    std::map<std::string, std::vector<NumberChange>> by_technique;
    for (const NumberChange& c : errors) by_technique[c.technique].push_back(c);
    std::cout << std::left << std::setw(32) << "" << std::right << std::setw(8) << "numbers";
    for (const char* verdict : verdicts) std::cout << std::setw(int(std::string(verdict).size()) + 3) << verdict;
    std::cout << '\n';
    for (const auto& [technique, own] : by_technique) {
        std::cout << std::left << std::setw(32) << shown_text(technique) << std::right << std::setw(8) << own.size();
        for (const char* verdict : verdicts)
            std::cout << std::setw(int(std::string(verdict).size()) + 3) << count_of(own, verdict);
        std::cout << '\n';
    }
}

void print_changes(const std::vector<NumberChange>& all, bool shows_all) {
    std::vector<const NumberChange*> changed;
    for (const NumberChange& c : all)
        if (c.verdict == change::changed) changed.push_back(&c);
    std::ranges::stable_sort(changed, std::greater{}, [](const NumberChange* c) { return c->size(); });
    const size_t count = shows_all ? changed.size() : std::min(changed.size(), most_named);
    for (size_t i = 0; i < count; ++i) {
        const NumberChange& c = *changed[i];
        std::string what = c.shot + (c.frame.empty() ? "" : " frame " + c.frame) + ": " + c.technique + " " + c.point +
                           ": " + c.metric;
        if (!c.target.empty()) what += " of " + c.target + ", " + c.mask + " pixels";
        std::cout << "  " << shown_text(what);
        std::cout << ": " << std::setprecision(4) << *c.before << " -> " << *c.after << " (x" << *c.after / *c.before
                  << ", " << c.how << ")\n";
    }
    if (count < changed.size()) std::cout << "  and " << changed.size() - count << " more; --all lists them\n";
}

void print_alone(const std::filesystem::path& folder, const std::vector<std::array<std::string, 3>>& points) {
    if (points.empty()) return;
    const auto& [shot, technique, point] = points.front();
    std::cout << "\nIn " << shown_text(folder.string()) << " alone, and not compared: " << points.size()
              << " points of shots, as " << shown_text(shot + " " + technique + " " + point) << '\n';
}

void print_times(const StudyDiff& diff, const DiffOptions& options) {
    if (!diff.moved.empty()) {
        std::cout << "\nTimes of " << diff.moved.size() << " shots are of different machines and are not compared:\n";
        for (const MovedShot& m : diff.moved)
            std::cout << "  " << shown_text(m.shot + ": " + m.before + " / " + m.after) << '\n';
    }
    if (diff.times.empty()) return;
    const size_t changed = count_of(diff.times, change::changed);
    std::cout << '\n' << changed << " of " << diff.times.size() << " times changed";
    std::map<std::string, size_t> why;
    for (const NumberChange& c : diff.times)
        if (c.verdict == change::not_judged) ++why[c.how];
    for (const auto& [reason, count] : why)
        std::cout << "; " << count << " are not compared (" << shown_text(reason) << ")";
    std::cout << (changed > 0 ? ":\n" : ".\n");
    print_changes(diff.times, options.shows_all);
}

}  // namespace

int diff_command(const DiffOptions& options) {
    const StudyResults before = read_study_results(options.before), after = read_study_results(options.after);
    const StudyDiff diff = diff_studies(before, after, options.judges_times,
                                        options.margin > 0 ? options.margin : primary_of(after.manifest).margin);
    if (diff.errors.empty())
        fail(options.before.string(), " and ", options.after.string(), " have no shot and point in common");
    print_techniques(diff.errors);
    const size_t changed = count_of(diff.errors, change::changed);
    std::cout << '\n' << changed << " of " << diff.errors.size() << " errors changed" << (changed > 0 ? ":\n" : ".\n");
    print_changes(diff.errors, options.shows_all);
    print_alone(options.before, diff.only_before), print_alone(options.after, diff.only_after);
    print_times(diff, options);
    if (!options.csv.empty()) {
        std::vector<NumberChange> all = diff.errors;
        all.insert(all.end(), diff.times.begin(), diff.times.end());
        write_rows(options.csv, all);
    }
    if (!options.page.empty()) {
        write_diff_page(options.page, diff, {options.before, before.manifest}, {options.after, after.manifest});
        std::cout << "\nPage: " << shown_text(options.page.string()) << '\n';
    }
    return changed > 0 || (options.judges_times && count_of(diff.times, change::changed) > 0) ? 1 : 0;
}

void add_diff(Commands& line) {
    DiffOptions& diff = line.keep<DiffOptions>();
    CLI::App& command = line.add("diff",
                                 "List the numbers that differ significantly between two results folders (exit code 1 "
                                 "if any does; at most 5 % false alarms)",
                                 "ssrlab diff results/last_week results/my_rooms --page diff.html");
    option(command, "old OLD", diff.before, "Results folder that `ssrlab run` filled")->required();
    option(command, "new NEW", diff.after, "Another results folder, with the same shots and points")->required();
    command.add_flag("--times", diff.judges_times,
                     "Also compare times. Their p-values are adjusted together with those of the errors");
    command.add_flag("--all", diff.shows_all, "List all changes, not only the largest");
    option(command, "--csv FILE.csv", diff.csv, "Also write all compared numbers, with p-values and verdicts");
    option(command, "--page FILE.html", diff.page,
           "Also write a page that shows both pictures, their difference and the numbers of each change");
    add_margin(command, diff.margin, "the new study's `primary.margin`");
    add_reading(command);
    command.callback([&] { line.status = diff_command(diff); });
}
