// ssrlab stability: what techniques bear.
#include "core/error.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "experiments/commands.h"
#include "experiments/progress.h"
#include "experiments/stability/stability.h"

#include <algorithm>
#include <cstdio>

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

}  // namespace

int stability_command(const StabilityOptions& options, const CommonOptions& common) {
    const std::string kind = options.figure.extension().string();
    if (!options.figure.empty() && kind != ".pdf" && kind != ".png" && kind != ".svg")
        fail("--figure ", options.figure.string(), ": its name must end with .pdf, .png or .svg");
    Device device(common.device);
    const std::filesystem::path table = options.table.empty() ? stability_case_table() : options.table;
    std::filesystem::create_directories(options.out);
    Progress progress(1.0);
    const auto write = [&](const std::vector<StabilityRow>& rows) {
        write_text(options.out / "stability.csv", stability_csv(rows));
        write_text(options.out / "stability_stages.csv", stability_stages_csv(rows, options.has_all_stages));
    };
    const auto done = [&](const std::vector<StabilityRow>& rows, double share) {
        const StabilityRow& row = rows.back();
        if (row.variant == "path_tracer") write(rows);  // the first of each case
        progress.update(share, row.case_name + ": " + name_of(row));
        if (const std::string line = complaint(row); !line.empty()) progress.say(line);
    };
    const std::vector<StabilityRow> rows =
        run_stability(device, table, {options.cases, options.variants}, scene_search_path(common.scene_path), done);
    write(rows);
    print_verdicts(rows);
    std::printf("\nTables: %s, and by stage stability_stages.csv\n", (options.out / "stability.csv").string().c_str());
    if (options.figure.empty()) return 0;
    return stability_figure(options.out / "stability.csv", options.figure);
}
