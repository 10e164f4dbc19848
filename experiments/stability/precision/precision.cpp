#include "experiments/stability/precision/precision.h"

#include "core/error.h"
#include "experiments/stability/precision/precision_judge.h"

std::vector<StabilityPoint> precision_points() {
    const auto with = [](const std::string& tracer) { return StabilityPoint{"mcguire_dda", "", {{"tracer", tracer}}}; };
    return {{"mcguire_dda", ""},
            with("hierarchy"),
            with("cells"),
            with("fixed_stride"),
            with("view_space"),
            {"simple_ssr", "corrected"},
            {"four_mode_ssr", "custom"},
            {"amd_sssr", "repeatable"},
            {"diligent_ssr", "current"},
            {"frostbite_sssr", "frostbite_2015"}};
}

std::filesystem::path precision_case_table() {
    return std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/stability/precision/precision_cases.json";
}

std::vector<PrecisionRow> run_precision(Device& device, const std::filesystem::path& table,
                                        const StabilitySelection& selection,
                                        const std::vector<std::filesystem::path>& search_path,
                                        const std::function<void(const std::vector<PrecisionRow>&, double)>& done) {
    if (!device.has_doubles()) fail_machine("the Vulkan device '", device.info().name, "' has no doubles in shaders");
    const std::vector<StabilityCase> cases = chosen_cases(table, selection.cases);
    const std::vector<StabilityPoint> points =
        selection.variants.empty() ? precision_points() : chosen_points(selection.variants);
    TruthStore truths;
    CaseDrawer drawer(device, search_path, truths);
    std::vector<PrecisionRow> rows = lobe_rows(device);
    for (size_t c = 0; c < cases.size(); ++c) {
        const PrecisionShot shot(drawer, cases[c], search_path);
        for (size_t p = 0; p < points.size(); ++p) {
            for (PrecisionRow& row : PrecisionJudge(device, shot, points[p]).rows()) {
                row.case_name = cases[c].name, row.variant = points[p].variant, row.point = points[p].label();
                rows.push_back(std::move(row));
            }
            done(rows, (double(c) + double(p + 1) / double(points.size())) / double(cases.size()));
        }
    }
    return rows;
}
