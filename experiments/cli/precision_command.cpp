// ssrlab stability --precision: the error of half floats and floats.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/stability_options.h"
#include "experiments/study/progress.h"
#include "experiments/study/stability/precision/precision.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace {

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

int precision_command(const StabilityOptions& options, const CommonOptions& common) {
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
    std::printf("\nTable: %s\n", csv.string().c_str());
    return 0;
}
