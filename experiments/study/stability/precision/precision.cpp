#include "experiments/study/stability/precision/precision.h"

#include "core/error.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/stability/precision/precision_judge.h"

const char* name_of(PrecisionKind kind) {
    constexpr const char* names[] = {"method", "own", "half", "input", "arithmetic", "rays", "march"};
    return names[size_t(kind)];
}

std::vector<PointConfig> precision_points() {
    const auto with = [](const char* tracer) { return single_point("mcguire_dda", "", {{"tracer", tracer}}); };
    return {single_point("mcguire_dda"),
            with("hierarchy"),
            with("cells"),
            with("fixed_stride"),
            with("view_space"),
            single_point("simple_ssr", "corrected"),
            single_point("four_mode_ssr", "custom"),
            single_point("amd_sssr", "repeatable"),
            single_point("diligent_ssr", "current"),
            single_point("frostbite_sssr", "frostbite_2015")};
}

std::filesystem::path precision_case_table() {
    return std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/study/stability/precision/precision_cases.json";
}

std::vector<PrecisionRow> run_precision(Device& device, const StabilitySelection& selection,
                                        const StabilityFolders& folders,
                                        const std::function<void(const std::vector<PrecisionRow>&, double)>& done) {
    if (!device.has_doubles()) fail_machine("the Vulkan device '", device.info().name, "' has no doubles in shaders");
    const std::vector<StabilityCase> cases = chosen_cases(selection);
    const std::vector<PointConfig> points =
        selection.techniques.empty() ? precision_points() : all_points(selection.techniques);
    CaseDrawer drawer(device, folders.search_path, folders.cache, points);
    std::vector<PrecisionRow> rows = lobe_rows(device);
    for (size_t c = 0; c < cases.size(); ++c) {
        const PrecisionShot shot(drawer.draw(cases[c].scene, cases[c].faults));
        for (size_t p = 0; p < points.size(); ++p) {
            for (PrecisionRow& row : PrecisionJudge(device, shot, points[p]).rows()) {
                row.case_name = cases[c].name, row.technique = points[p].technique, row.point = points[p].point;
                rows.push_back(std::move(row));
            }
            done(rows, (double(c) + double(p + 1) / double(points.size())) / double(cases.size()));
        }
    }
    return rows;
}
