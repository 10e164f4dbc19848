// ssrlab run: a study.
#include "core/cache_folder.h"
#include "core/scene/load_scene.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/config_of_study.h"
#include "experiments/report/report.h"
#include "experiments/study/run.h"

#include <limits>

namespace {

struct RunOptions {
    std::filesystem::path config, out;
    bool keep_all = false, replaces = false, prunes = false, takes_times_here = false, takes_times_again = false;
    bool has_no_report = false;
    double report_after = RunSettings{}.report_after;
    std::vector<std::string> cells;  ///< as CellSelection takes them; empty: all
};

}  // namespace

static void run_study_command(const RunOptions& options, const CommonOptions& common) {
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
               .report_after = options.report_after,
               .write_report = options.has_no_report ? nullptr : write_page,
               .cells = options.cells});
}

void add_run(Commands& line) {
    RunOptions& run = line.keep<RunOptions>();
    CLI::App& command = line.add("run", "Run a study: shots x techniques x parameter points x seeds");
    option(command, "config CONFIG.json", run.config, "The study (experiments/README.md explains its keys)")
        ->required();
    option(command, "--out DIR", run.out,
           "Results folder; default: results/<name of the config>. A stopped study continues there");
    command.add_flag("--keep-all", run.keep_all,
                     "Also do work that can be skipped (to verify that skipping it changes nothing)");
    command.add_flag("--replace", run.replaces,
                     "Use a results folder of another study for this one; cells that both share are kept");
    command.add_flag("--prune", run.prunes, "Remove cells and images of earlier versions of the study from its folder");
    command.add_flag("--times-here", run.takes_times_here,
                     "Take times on this machine again; by default those of another machine are kept");
    command.add_flag("--times-again", run.takes_times_again,
                     "Take times again that other programs disturbed; the less disturbed are kept");
    command.add_flag("--no-report", run.has_no_report,
                     "Write tables and images alone; `ssrlab report` makes the report of them later");
    option(command, "--report-after SECONDS", run.report_after,
           "Seconds of a running study until it writes tables and report of what is done; it goes on to do so for a "
           "twenty-fifth of the time, after ten minutes for half a hundredth")
        ->check(real_in(0, std::numeric_limits<double>::max(), "a number of 0 or more"))
        ->capture_default_str();
    option(command, "--cells TERM", run.cells,
           "Do only these cells, of a study that several processes or machines share: references, renders, costs, "
           "times; shot=NAME, technique=NAME (* stands for any text); shard=I/N; cell=HASH. Terms of different kinds "
           "narrow each other. Tables are made by `ssrlab merge`")
        ->delimiter(',');
    add_device(command, line.common), add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { run_study_command(run, line.common); });
}
