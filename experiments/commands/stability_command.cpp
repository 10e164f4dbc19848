// ssrlab stability: techniques under extreme inputs.
#include "core/error.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "experiments/commands/commands.h"
#include "experiments/report/report.h"
#include "experiments/run/progress.h"
#include "experiments/stability/stability.h"
#include "experiments/stability/stability_report.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace {

std::string name_of(const StabilityRow& row) { return row.variant + (row.point == "default" ? "" : " " + row.point); }

/// One line for what went wrong; "" for what did not.
std::string complaint(const StabilityRow& row) {
    if (row.verdict <= Verdict::worse) return {};
    std::string line = row.case_name + ": " + name_of(row) + ": " + verdict_names()[size_t(row.verdict)].name;
    if (!row.run.refusal.empty()) return line + ": " + row.run.refusal;
    if (row.run.non_finite) line += ", first in " + row.run.first_non_finite;
    if (row.run.spread_pixels) line += ", " + std::to_string(row.run.spread_pixels) + " pixels";
    if (row.run.spread_frames) line += " and " + std::to_string(row.run.spread_frames) + " more frames";
    const auto count = [&](size_t pixels, const char* what) {
        if (pixels) line += ", " + std::to_string(pixels) + what;
    };
    count(row.run.negative, " negative"), count(row.run.too_bright, " too bright");
    count(row.run.bad_confidence, " of a confidence outside [0, 1]");
    return line;
}

/// How many cases each technique got each verdict in.
void print_verdicts(const std::vector<StabilityRow>& rows) {
    std::vector<std::string> names;
    std::map<std::string, std::vector<unsigned>> counts;
    for (const StabilityRow& row : rows) {
        const std::string name = name_of(row);
        if (!std::ranges::count(names, name)) names.push_back(name);
        auto& count = counts[name];
        count.resize(verdict_names().size());
        ++count[size_t(row.verdict)];
    }
    std::printf("\n%-36s", "cases by verdict");
    for (const VerdictName& verdict : verdict_names()) std::printf("%19s", verdict.name.c_str());
    for (const std::string& name : names) {
        std::printf("\n%-36s", name.c_str());
        for (const unsigned count : counts[name]) std::printf("%19u", count);
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

int stability_command(const StabilityOptions& options, const CommonOptions& common) {
    const std::string kind = options.figure.extension().string();
    if (!options.figure.empty() && kind != ".pdf" && kind != ".png" && kind != ".svg")
        fail("--figure ", options.figure.string(), ": its name must end with .pdf, .png or .svg");
    const std::vector<std::unique_ptr<Device>> devices = open_devices(common.device);
    std::vector<Device*> workers;
    for (const auto& device : devices) workers.push_back(device.get());
    const std::filesystem::path table = options.table.empty() ? stability_case_table() : options.table;
    std::filesystem::create_directories(options.out);
    write_text(options.out / "stability_cases.csv", stability_cases_csv(read_stability_cases(table)));
    Progress progress(1.0);
    const auto write = [&](const std::vector<StabilityRow>& rows) {
        write_text(options.out / "stability.csv", stability_csv(rows));
        write_text(options.out / "stability_stages.csv", stability_stages_csv(rows, options.has_all_stages));
    };
    std::vector<StabilityRow> rows;
    const auto done = [&](const std::vector<StabilityRow>& rows_of_case, double share) {
        rows.insert(rows.end(), rows_of_case.begin(), rows_of_case.end());
        write(rows);
        if (!rows_of_case.empty()) progress.update(share, rows_of_case.front().case_name);
        for (const StabilityRow& row : rows_of_case)
            if (const std::string line = complaint(row); !line.empty()) progress.say(line);
    };
    rows = run_stability(workers, table, {options.cases, options.variants}, scene_search_path(common.scene_path), done);
    write(rows);
    print_verdicts(rows);
    const nlohmann::json data = stability_report_data(options.out);
    std::printf("\n%s\n%s\n", failures_text(data).c_str(), data["lead"].get_ref<const std::string&>().c_str());
    write_report(options.out);
    std::printf("\nReport: %s\n", (options.out / "report.html").string().c_str());
    if (options.figure.empty()) return 0;
    return stability_figure(options.out / "stability.csv", options.figure);
}
