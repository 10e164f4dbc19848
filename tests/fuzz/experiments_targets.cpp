// The readers of studies, techniques' folders, tables of cases, and results.
#include "core/files.h"
#include "core/json.h"
#include "experiments/bridges/inspect/page.h"
#include "experiments/results/cells/cell.h"
#include "experiments/results/files/columns.h"
#include "experiments/results/verdicts/study_results.h"
#include "experiments/study/config/config.h"
#include "experiments/study/stability/stability_case.h"
#include "tests/fuzz/targets.h"
#include "variants/declared/declared_entry.h"

namespace fs = std::filesystem;

namespace {

/// The tables beside a manifest.
void copy_tables(const fs::path& folder) {
    fs::copy(fs::path(SSRLAB_SOURCE_DIR) / "tests/data/fuzz/results_folder", folder);
}

/// The shaders beside a technique.json.
void write_shaders(const fs::path& folder) {
    write_text(folder / "my_ssr/shade.comp", "#include \"own.glsl\"\n#include \"common/halton.h\"\nvoid main() {}\n");
    write_text(folder / "my_ssr/own.glsl", "");
}

const FuzzTarget targets[] = {
    {"technique", "my_ssr/technique.json", [](const fs::path& file) { declared_entry(file.parent_path()); },
     write_shaders},
    {"config", "study.json", [](const fs::path& file) { read_config(file); }},
    {"cases", "cases.json", [](const fs::path& file) { read_stability_cases(file); }},
    {"cell", "cell.json", [](const fs::path& file) { read_cell(read_json(file), file.string()); }},
    {"manifest", "manifest.json", [](const fs::path& file) { read_study_results(file.parent_path()); }, copy_tables},
    {"inspect", "input.glb",  // its bytes say what it is
     [](const fs::path& file) { page_of(inspect(file.string(), {}).description, true); }},
    {"results", "results.csv", [](const fs::path& file) { read_rows<ResultRow>(file); }},
};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return targets; }
