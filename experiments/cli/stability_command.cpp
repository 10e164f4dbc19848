// ssrlab stability: techniques under extreme inputs, and in half floats, floats and doubles.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/script_commands.h"
#include "experiments/report/report.h"
#include "experiments/results/stability/stability_results.h"
#include "experiments/study/progress.h"
#include "experiments/study/stability/precision/precision.h"
#include "experiments/study/stability/stability.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <thread>

namespace {

struct StabilityOptions {
    std::vector<std::string> techniques, cases;  ///< empty: all
    bool has_all_stages = false, is_of_precision = false;
    std::filesystem::path table, out, figure;  ///< table "": ssrlab's own; figure "": none
};

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

/// The worst of one comparison over the cases.
struct Worst {
    double share = 0, p999 = 0, differing = 0;
    std::string case_name, refusal;
    size_t non_finite = 0;
};

std::string title_of(const PrecisionRow& r) {
    const bool is_format = r.kind == PrecisionKind::own || r.kind == PrecisionKind::half;
    const std::string what = r.stage.empty()   ? "all"
                             : is_format       ? r.image + ' ' + r.format
                             : r.image.empty() ? r.stage
                                               : r.stage + ": " + r.image;
    char line[256];
    std::snprintf(line, sizeof line, "%-28s %-10s %-46s", (r.technique + ' ' + r.point).c_str(), name_of(r.kind),
                  what.c_str());
    return line;
}

void print_table(const std::vector<PrecisionRow>& rows) {
    std::vector<std::string> order;
    std::map<std::string, Worst> table;
    for (const PrecisionRow& r : rows) {
        if (r.kind == PrecisionKind::method) continue;
        const std::string line = title_of(r);
        const auto [entry, is_new] = table.try_emplace(line);
        if (is_new) order.push_back(line);
        Worst& worst = entry->second;
        worst.non_finite += r.non_finite;
        if (!r.refusal.empty()) worst.refusal = r.refusal;
        worst.p999 = std::max(worst.p999, r.value_p999.value_or(0.0));
        worst.differing = std::max(worst.differing, r.differing.value_or(0.0));
        if (r.share.value_or(0.0) > worst.share) worst.share = *r.share, worst.case_name = r.case_name;
    }
    std::printf("\n%-28s %-10s %-46s%10s %-10s%10s%10s\n", "the worst of all cases", "", "", "share", "in", "p999",
                "differing");
    for (const std::string& line : order) {
        const Worst& w = table[line];
        std::printf("%s%10.1e %-10s%10.1e%10.1e", line.c_str(), w.share, shown_text(w.case_name).c_str(), w.p999,
                    w.differing);
        if (w.share > negligible_share) std::printf("  counts");
        if (w.non_finite) std::printf("  %zu pixels not finite", w.non_finite);
        std::printf("%s%s\n", w.refusal.empty() ? "" : "  refused: ", shown_text(w.refusal).c_str());
    }
    std::printf(
        "\nshare: squared change of the picture over the method's squared error; it counts above %g\n"
        "p999: 99.9th percentile of the relative change of values, or of rays\n"
        "differing: share of values that change at all; of a march, of rays that end in another pixel\n",
        negligible_share);
}

}  // namespace

/// `ssrlab stability --precision`: the error of half floats and floats. Returns the exit code, 0.
static int precision_command(const StabilityOptions& options, const CommonOptions& common) {
    if (!options.figure.empty() || options.has_all_stages)
        fail("--figure and --all-stages do not apply to --precision");
    Device device(common.device);
    create_folder(options.out);
    const std::filesystem::path csv = options.out / "stability_precision.csv";
    Progress progress(1.0);
    const auto done = [&](const std::vector<PrecisionRow>& rows, double share) {
        const PrecisionRow& row = rows.back();
        write_rows(csv, rows);
        progress.update(share, row.case_name + ": " + row.technique + " " + row.point);
    };
    const StabilitySelection selection{.table = options.table.empty() ? precision_case_table() : options.table,
                                       .cases = options.cases,
                                       .techniques = options.techniques};
    const StabilityFolders folders{.search_path = scene_search_path(common.scene_path),
                                   .cache = common.cache.empty() ? default_cache_folder() : common.cache};
    const std::vector<PrecisionRow> rows = run_precision(device, selection, folders, done);
    print_table(rows);
    std::printf("\nTable: %s\n", shown_text(csv.string()).c_str());
    return 0;
}

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
    if (const std::string hidden = hidden_text(rows); !hidden.empty()) std::printf("\n%s", hidden.c_str());
    write_report(options.out);
    std::printf("\nReport: %s\n", shown_text((options.out / "report.html").string()).c_str());
    if (options.figure.empty()) return 0;
    return stability_figure(options.out / "stability.csv", options.figure);
}

void add_stability(Commands& line) {
    StabilityOptions& stability = line.keep<StabilityOptions>();
    CLI::App& command = line.add(
        "stability",
        "Test techniques with extreme inputs: values that are not finite, and small changes that are amplified",
        "ssrlab stability --techniques ./my_ssr --cases faults");
    option(command, "--techniques NAME", stability.techniques,
           "Techniques, folders of techniques, or single presets as NAME:PRESET; default: all presets of all "
           "techniques, and all tracers")
        ->delimiter(',');
    option(command, "--cases NAME", stability.cases, "Cases, or groups of cases, of the table; default: all")
        ->delimiter(',');
    option(command, "--table FILE.json", stability.table,
           "Table of cases (`experiments/study/stability/README.md`); default: the included table");
    option(command, "--out DIR", stability.out, "Folder of stability.csv")->default_val("results/stability");
    command.add_flag("--all-stages", stability.has_all_stages,
                     "List every stage in stability_stages.csv, also finite ones");
    option(command, "--figure FILE", stability.figure, "Also write a figure as .pdf, .png or .svg");
    command.add_flag("--precision", stability.is_of_precision,
                     "Test formats and arithmetic instead: half, float and double, one image and one stage at a time. "
                     "Takes 5 minutes and writes stability_precision.csv");
    add_device(command, line.common), add_scene_path(command, line.common);
    add_cache(command, line.common);
    add_reading(command);
    command.callback([&] {
        line.status = stability.is_of_precision ? precision_command(stability, line.common)
                                                : stability_command(stability, line.common);
    });
}
