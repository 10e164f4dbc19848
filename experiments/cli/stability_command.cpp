// ssrlab stability: techniques under extreme inputs.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/script_commands.h"
#include "experiments/cli/stability_options.h"
#include "experiments/report/report.h"
#include "experiments/results/stability/stability_results.h"
#include "experiments/study/progress.h"
#include "experiments/study/stability/stability.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace {

/// One line for what went wrong; "" for what did not.
std::string complaint(const StabilityRow& row) {
    if (row.verdict <= Verdict::worse) return {};
    std::string line = row.case_name + ": " + point_text({row.technique, row.point}) + ": " + csv_field(row.verdict);
    if (!row.refusal.empty()) return line + ": " + row.refusal;
    if (row.non_finite) line += ", first in " + row.first_non_finite;
    if (row.spread_pixels) line += ", " + std::to_string(row.spread_pixels) + " pixels";
    if (row.spread_frames) line += " and " + std::to_string(row.spread_frames) + " more frames";
    const auto count = [&](size_t pixels, const char* what) {
        if (pixels) line += ", " + std::to_string(pixels) + what;
    };
    count(row.negative, " negative"), count(row.too_bright, " too bright");
    count(row.bad_confidence, " of a confidence outside [0, 1]");
    return line;
}

void print_verdicts(const std::vector<StabilityRow>& rows) {
    std::printf("\n%-36s", "cases by verdict");
    for (const VerdictName& verdict : verdict_names()) std::printf("%19s", verdict.name.c_str());
    for (const auto& [name, counts] : verdict_counts(rows)) {
        std::printf("\n%-36s", name.c_str());
        for (const size_t count : counts) std::printf("%19zu", count);
    }
    std::printf("\n\n");
    for (const VerdictName& verdict : verdict_names())
        std::printf("%s: %s\n", verdict.name.c_str(), verdict.meaning.c_str());
}

/// On a CPU one for each core. lavapipe then draws in the calling thread: pictures this small take a fifth less
/// of a core's time than with threads that wait for each other, and a frame's time is that of one core, whatever the
/// other devices do.
std::vector<std::unique_ptr<Device>> open_devices(const std::string& choice) {
    ::setenv("LP_NUM_THREADS", "0", 0);
    std::vector<std::unique_ptr<Device>> devices;
    devices.push_back(std::make_unique<Device>(choice));
    if (devices.front()->info().is_cpu())
        while (devices.size() < std::thread::hardware_concurrency())
            devices.push_back(std::make_unique<Device>(choice));
    return devices;
}

}  // namespace

static int stability_command(const StabilityOptions& options, const CommonOptions& common) {
    const std::string kind = lower_case_extension(options.figure);
    if (!options.figure.empty() && kind != ".pdf" && kind != ".png" && kind != ".svg")
        fail("--figure ", options.figure.string(), ": its name must end with .pdf, .png or .svg");
    const std::vector<std::unique_ptr<Device>> devices = open_devices(common.device);
    std::vector<Device*> workers;
    for (const auto& device : devices) workers.push_back(device.get());
    const StabilitySelection selection{.table = options.table.empty() ? stability_case_table() : options.table,
                                       .cases = options.cases,
                                       .techniques = options.techniques};
    const StabilityFolders folders{.search_path = scene_search_path(common.scene_path),
                                   .cache = common.cache.empty() ? default_cache_folder() : common.cache};
    const std::vector<StabilityCase> cases = read_stability_cases(selection.table);
    create_folder(options.out);
    write_rows(options.out / "stability_cases.csv", std::vector<StabilityCaseName>(cases.begin(), cases.end()));
    Progress progress(1.0);
    const auto write = [&](const std::vector<StabilityRow>& rows) {
        write_rows(options.out / "stability.csv", rows);
        write_rows(options.out / "stability_stages.csv", stage_rows(rows, options.has_all_stages));
    };
    std::vector<StabilityRow> rows;
    const auto done = [&](const std::vector<StabilityRow>& rows_of_case, double share) {
        rows.insert(rows.end(), rows_of_case.begin(), rows_of_case.end());
        write(rows);
        if (!rows_of_case.empty()) progress.update(share, rows_of_case.front().case_name);
        for (const StabilityRow& row : rows_of_case)
            if (const std::string line = complaint(row); !line.empty()) progress.say(line);
    };
    rows = run_stability(workers, selection, folders, done);
    write(rows);
    print_verdicts(rows);
    const StabilityResults tables = read_stability_results(options.out);
    std::printf("\n%s\n%s\n", failures_text(stage_failures(tables)).c_str(),
                shown_text(stability_lead(tables)).c_str());
    write_report(options.out);
    std::printf("\nReport: %s\n", (options.out / "report.html").string().c_str());
    if (options.figure.empty()) return 0;
    return stability_figure(options.out / "stability.csv", options.figure);
}

void add_stability(Commands& line) {
    StabilityOptions& stability = line.keep<StabilityOptions>();
    CLI::App& command = *line.app.add_subcommand(
        "stability", "Test techniques with extreme inputs: non-finite values and amplification");
    command
        .add_option("--techniques", stability.techniques,
                    "Techniques, or their folders, or single presets as NAME:PRESET; default: all presets of all, and "
                    "all tracers")
        ->delimiter(',')
        ->type_name("NAME");
    command.add_option("--cases", stability.cases, "Cases or groups of the table; default: all")
        ->delimiter(',')
        ->type_name("NAME");
    command
        .add_option("--table", stability.table,
                    "A table of cases (experiments/study/stability/README.md); default: ssrlab's own")
        ->check(CLI::ExistingFile)
        ->type_name("FILE.json");
    command.add_option("--out", stability.out, "Folder of stability.csv")
        ->default_val("results/stability")
        ->type_name("DIR");
    command.add_flag("--all-stages", stability.has_all_stages,
                     "List every stage in stability_stages.csv, also those that are finite");
    command.add_option("--figure", stability.figure, "Also write the figure: .pdf, .png or .svg")->type_name("FILE");
    command.add_flag("--precision", stability.is_of_precision,
                     "Instead: formats and arithmetic, in half, float and double, one image and "
                     "one stage at a time (5 minutes; stability_precision.csv)");
    add_device(command, line.common), add_scene_path(command, line.common);
    add_cache(command, line.common);
    add_reading(command);
    command.callback([&] {
        line.status = stability.is_of_precision ? precision_command(stability, line.common)
                                                : stability_command(stability, line.common);
    });
}
