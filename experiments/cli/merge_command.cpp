// ssrlab merge: the parts of a study.
#include "core/scene/load_scene.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/config_of_study.h"
#include "experiments/report/report.h"
#include "experiments/study/merge.h"

namespace {

struct MergeOptions {
    std::filesystem::path config, out;
    std::vector<std::filesystem::path> folders;
    bool keep_all = false, replaces = false;
};

}  // namespace

static int merge_command(const MergeOptions& options, const CommonOptions& common) {
    const std::filesystem::path out = options.out.empty() ? default_results(options.config) : options.out;
    const size_t missing = merge_study(config_of_study(options.config),
                                       {.out = out,
                                        .device = common.device,
                                        .search_path = scene_search_path(common.scene_path),
                                        .keep_all = options.keep_all,
                                        .replaces = options.replaces,
                                        .write_report = write_page},
                                       options.folders.empty() ? std::vector{out} : options.folders);
    return missing > 0 ? 1 : 0;
}

void add_merge(Commands& line) {
    MergeOptions& merge = line.keep<MergeOptions>();
    CLI::App& command =
        line.add("merge", "Merge the results folders of the parts of a study (`ssrlab run --cells`) into one",
                 "ssrlab merge my_study.json parts/1 parts/2 --out results/my_study");
    add_config(command, merge.config);
    option(command, "results DIR...", merge.folders, "Results folders of the parts; default: that of --out");
    option(command, "--out DIR", merge.out, "Results folder; default: results/<name of the config>");
    command.add_flag("--keep-all", merge.keep_all, "The parts were run with --keep-all");
    command.add_flag("--replace", merge.replaces, "As for `ssrlab run`");
    option(command, "--device NAME", line.common.device,
           "Device whose cells are merged if the parts hold cells of several devices: part of its name, or its index "
           "in `ssrlab list devices`. Default: the device that made all cells. This machine need not have it");
    add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { line.status = merge_command(merge, line.common); });
}
