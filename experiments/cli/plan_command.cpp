// ssrlab plan: the cells of a study, which of them are done, and the estimated cost of the others.
#include "core/cpu_times.h"
#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "core/reading_limits.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/config_of_study.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/study/plan/cell_selection.h"
#include "experiments/study/plan/estimate.h"
#include "experiments/study/plan/expected_time.h"
#include "experiments/study/plan/ranking_warnings.h"
#include "experiments/study/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>

namespace {

struct PlanOptions {
    std::filesystem::path config, out;
    std::filesystem::path json;      ///< file that gets all cells with their estimates; "": none
    std::vector<std::string> cells;  ///< as CellSelection takes them; empty: all
    bool has_list = false, keep_all = false;
};

// Beyond these a design is taken for a mistake.
constexpr size_t most_cells = 100000;
constexpr double most_days = 30;

struct PlannedWork {
    const PlannedCell* cell;
    bool is_done;
    CellEstimate estimate;
};

nlohmann::json json_of(const std::vector<PlannedWork>& work) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [cell, is_done, estimate] : work)
        list.push_back({{"cell", cell->name},
                        {"kind", name_of(cell->kind)},
                        {"what", cell->what},
                        {"shot", cell->shot},
                        {"done", is_done},
                        {"seconds", estimate.seconds},
                        {"processor_seconds", estimate.processor_seconds},
                        {"memory_mib", estimate.memory_mib}});
    return {{"cells", list}};
}

/// Of what is to be done.
ExpectedTime time_of(const std::vector<PlannedWork>& work) {
    ExpectedTime time;
    for (const PlannedWork& w : work)
        if (!w.is_done) time.seconds += w.estimate.seconds, time.processor_seconds += w.estimate.processor_seconds;
    return time;
}

void print_kinds(const std::vector<PlannedWork>& work) {
    std::printf("%-12s %7s %7s %7s   %-14s %s\n", "", "cells", "done", "to do", "takes about", "processor time");
    const auto print = [&](const std::string& name, const auto& is_counted) {
        std::vector<PlannedWork> counted;
        std::ranges::copy_if(work, std::back_inserter(counted), [&](const auto& w) { return is_counted(*w.cell); });
        const size_t all = counted.size(), done = size_t(std::ranges::count_if(counted, &PlannedWork::is_done));
        std::printf("%-12s %7zu %7zu %7zu", name.c_str(), all, done, all - done);
        const ExpectedTime time = time_of(counted);
        if (all > done)
            std::printf("   %-14s %s", format_duration(time.seconds).c_str(),
                        format_duration(time.processor_seconds).c_str());
        std::printf("\n");
    };
    for (const std::string& name : cell_kind_names())
        print(name, [&](const PlannedCell& cell) { return name_of(cell.kind) == name; });
    print("all", [](const PlannedCell&) { return true; });
}

void print_list(const std::vector<PlannedWork>& work) {
    for (const auto& [cell, is_done, estimate] : work)
        std::printf("%s  %-10s %s  %s\n", cell->name.c_str(), name_of(cell->kind).c_str(), is_done ? "done " : "to do",
                    shown_text(cell->what).c_str());
}

/// A design that would take the rest of the year, or fill the memory of this machine, if it is to run `here`.
void refuse_absurd(const std::vector<PlannedWork>& work, bool here) {
    const double seconds = time_of(work).seconds;
    double memory = 0;
    std::string largest;
    for (const PlannedWork& w : work) {
        if (w.is_done) continue;
        if (w.estimate.memory_mib > memory) memory = w.estimate.memory_mib, largest = w.cell->what;
    }
    if (seconds > most_days * 86400)
        fail("this would take about ", std::llround(seconds / 86400),
             " days here; sweep fewer values, or take fewer seeds, shots or samples");
    const double machine = double(machine_memory()) / 1048576;
    if (here && memory > machine)
        fail(largest, " would need about ", std::llround(memory), " MiB of memory, and this machine has ",
             std::llround(machine), "; give the shot a lower resolution");
}

}  // namespace

static void plan_command(const PlanOptions& options, const CommonOptions& common) {
    const Config config = config_of_study(options.config);
    const CellSelection selection(options.cells);
    const size_t cells = config.shots.size() * (config.techniques.size() + 2);
    if (cells > most_cells)
        fail(options.config.string(), ": ", config.shots.size(), " shots x ", config.techniques.size(), " points are ",
             cells, " cells; at most ", most_cells,
             " are planned: sweep fewer values, or draw from them (`random`, `sobol`)");
    const RunSettings settings{.out = options.out.empty() ? default_results(options.config) : options.out,
                               .device = common.device,
                               .search_path = scene_search_path(common.scene_path),
                               .keep_all = options.keep_all,
                               .cells = options.cells};
    // Estimating takes minutes of a large study: what cannot be written is said before.
    if (!options.json.empty()) create_folder(std::filesystem::absolute(options.json).parent_path());
    Device device(settings.device);
    const StudyPlan plan = plan_study(config, device.info(), settings.search_path, settings.keep_all);
    const CellStore store(settings.out,
                          [](const std::string& note) { std::fprintf(stderr, "%s\n", shown_text(note).c_str()); });
    std::vector<PlannedWork> work;
    for (const PlannedShot& shot : plan.shots)
        for (const PlannedCell& cell : shot.cells)
            if (selection.holds(cell)) work.push_back({&cell, store.read(cell.name).has_value(), {}});
    std::optional<double> load_of_others;
    const bool is_estimated = !options.has_list && std::ranges::any_of(work, [](const auto& w) { return !w.is_done; });
    if (is_estimated) {
        const StudyEstimate estimate = estimate_study(device, config, plan, settings);
        for (PlannedWork& w : work) w.estimate = estimate.cells.at(w.cell->name);
        load_of_others = estimate.load_of_others;
    }
    if (!options.json.empty()) write_text(options.json, json_of(work).dump(1) + "\n");
    if (options.has_list) return print_list(work);
    std::printf("%s: %s, %s\n\n", shown_text(options.config.string()).c_str(),
                counted(config.shots.size(), "shot").c_str(), counted(config.techniques.size(), "point").c_str());
    print_kinds(work);
    for (const std::string& warning : ranking_warnings(config, plan))
        std::printf("\nwarning: %s\n", shown_text(warning).c_str());
    if (!is_estimated) return;
    double memory = 0;
    for (const PlannedWork& w : work) memory = std::max(memory, w.is_done ? 0 : w.estimate.memory_mib);
    std::printf("\n%s\n", expected_time_text(time_of(work), load_of_others, read_cpu_times().cpus).c_str());
    std::printf(
        "\nOn this machine and %s; at most about %lld MiB of memory. Estimated from small images and references at "
        "their limit of samples; cached references are reused.\n",
        device.info().name.c_str(), std::llround(memory));
    std::printf("\nIt is run by:\n  %s\n", command_line("run", config, settings).c_str());
    refuse_absurd(work, options.json.empty());
}

void add_plan(Commands& line) {
    PlanOptions& plan = line.keep<PlanOptions>();
    CLI::App& command = line.add(
        "plan", "Show how many cells of a study are done, and how long and how much memory the others will take",
        "ssrlab plan quickstart");
    add_config(command, plan.config);
    option(command, "--out DIR", plan.out, "Results folder of the study; default: results/<name of the config>");
    option(command, "--cells TERM", plan.cells, "Consider only these cells; terms as for `ssrlab run`")->delimiter(',');
    command.add_flag("--list", plan.has_list, "List the cells instead of estimates");
    option(command, "--json FILE.json", plan.json,
           "Also write all cells with their estimates as JSON, to distribute them to other machines. The memory of "
           "this machine is then no limit");
    command.add_flag("--keep-all", plan.keep_all, "As for `ssrlab run`");
    add_device(command, line.common), add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { plan_command(plan, line.common); });
}
