// ssrlab run: a study.
#include "core/cache_folder.h"
#include "core/scene/load_scene.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/config_of_study.h"
#include "experiments/report/report.h"
#include "experiments/study/run.h"

#include <unistd.h>
#include <cstdio>
#include <functional>
#include <iostream>
#include <limits>

namespace {

struct RunOptions {
    std::filesystem::path config, out;
    bool keep_all = false, replaces = false, prunes = false, takes_times_here = false, takes_times_again = false;
    bool has_no_report = false, is_confirmed = false;
    double report_after = RunSettings{}.report_after;
    std::vector<std::string> cells;  ///< as CellSelection takes them; empty: all
};

/// What a person answers who sees the question; without one, nothing is asked.
std::function<bool()> confirmation(const RunOptions& options, const std::vector<EndedPoint>& ended) {
    if (options.is_confirmed || !ended.empty() || !isatty(STDIN_FILENO) || !isatty(STDERR_FILENO)) return {};
    return [] {
        std::fputs("Start it? [y/N] ", stderr);
        std::string answer;
        std::getline(std::cin, answer);
        return answer == "y" || answer == "Y" || answer == "yes";
    };
}

}  // namespace

static void run_study_command(const RunOptions& options, const CommonOptions& common,
                              const std::vector<EndedPoint>& ended) {
    run_study(config_of_study(options.config),
              {.out = options.out.empty() ? default_results(options.config) : options.out,
               .device = common.device,
               .cache = common.cache.empty() ? default_cache_folder() : common.cache,
               .search_path = scene_search_path(common.scene_path),
               .keep_all = options.keep_all,
               .replaces = options.replaces,
               .prunes = options.prunes,
               .takes_times_here = options.takes_times_here,
               .takes_times_again = options.takes_times_again,
               .confirm = confirmation(options, ended),
               .report_after = options.report_after,
               .write_report = options.has_no_report ? nullptr : write_page,
               .cells = options.cells,
               .ended = ended});
}

void add_run(Commands& line) {
    RunOptions& run = line.keep<RunOptions>();
    CLI::App& command = line.add("run", "Run a study: render and measure every point of every technique in every shot",
                                 "ssrlab run quickstart");
    add_config(command, run.config);
    option(command, "--out DIR", run.out,
           "Results folder; default: results/<name of the config>. A stopped study continues in its folder");
    command.add_flag("--keep-all", run.keep_all,
                     "Also do work that the scene does not need, to verify that leaving it out changes nothing");
    command.add_flag("--replace", run.replaces,
                     "Take over the results folder of another study. Cells that both studies share are kept");
    command.add_flag("--prune", run.prunes,
                     "Remove cells and images of earlier versions of the study from the results folder");
    command.add_flag("--times-here", run.takes_times_here,
                     "Measure all times on this machine again. By default, times from another machine are kept");
    command.add_flag("--times-again", run.takes_times_again,
                     "Measure times again that other programs disturbed, and keep the less disturbed ones");
    command.add_flag("--yes", run.is_confirmed,
                     "Start without a question. On a terminal, a study of more than an hour asks first");
    command.add_flag("--no-report", run.has_no_report,
                     "Write tables and images, but no report. `ssrlab report` writes the report later");
    option(command, "--report-after SECONDS", run.report_after,
           "Seconds after which a running study first writes tables and report of the finished cells. It writes them "
           "again from time to time and spends at most 4 % of the time on that, 0.5 % after ten minutes")
        ->check(real_in(0, std::numeric_limits<double>::max(), "a number of 0 or more"))
        ->capture_default_str();
    option(
        command, "--cells TERM", run.cells,
        "Do only some cells, so that several processes or machines share a study. Terms: references, renders, costs, "
        "times, shot=NAME, technique=NAME, shard=I/N, cell=HASH; * in a name stands for any text. Terms of one kind "
        "add up, and terms of different kinds narrow the choice. `ssrlab merge` makes the tables afterwards")
        ->delimiter(',');
    add_device(command, line.common), add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { run_study_command(run, line.common, line.ended); });
}
