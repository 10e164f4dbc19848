#include "tests/experiments/report/report_stability_fixture.h"

#include "core/files.h"
#include "experiments/stability/stability_rows.h"

namespace {

StabilityCase made_up_case(const std::string& name, const std::string& group, const std::string& why) {
    StabilityCase result;
    result.name = result.family = name, result.group = group, result.why = why;
    return result;
}

StabilityRow made_up_row(const StabilityCase& what, const std::string& variant, const std::string& point) {
    StabilityRow row{.case_name = what.name, .group = what.group, .variant = variant, .point = point};
    row.error = 0.25, row.benign_error = 0.2;
    return row;
}

/// `nan` and `infinite` values in one image, of which the first that is added is where they arise.
void add_failure(StabilityRow& row, const std::string& stage, const std::string& image, size_t nan, size_t infinite) {
    row.run.stages.push_back({.stage = stage, .image = image, .nan = nan, .infinite = infinite, .largest = 2.0f});
    row.run.non_finite += nan + infinite;
    if (row.run.first_non_finite.empty()) row.run.first_non_finite = stage + ": " + image;
}

}  // namespace

void write_stability_fixture(const std::filesystem::path& folder) {
    const std::vector<StabilityCase> cases = {
        made_up_case("plain", "plain", "what the others are compared with"),
        made_up_case("bad hit lit nan", "faults", "whose <b>result</b> is it in?"),
        made_up_case("far away", "depth", "codes of depth end"), made_up_case("black", "radiance", "0 / 0"),
        made_up_case("one pixel", "sizes", "no level to halve")};
    std::vector<StabilityRow> rows;
    for (const StabilityCase& c : cases)
        for (const auto& [variant, point] :
             {std::pair("path_tracer", "default"), std::pair("amd_sssr", "slides"), std::pair("amd_sssr", "corrected"),
              std::pair("of_another_build", "default")})
            rows.push_back(made_up_row(c, variant, point));
    const auto row = [&](size_t c, size_t technique) -> StabilityRow& { return rows[c * 4 + technique]; };
    for (const size_t technique : {1u, 2u, 3u})
        row(0, technique).amplifications = {
            {"depth", 300.0 / double(technique), 9e4}, {"normal", 1, 20}, {"lit", 0, 3}};
    StabilityRow& spreads = row(1, 1);
    add_failure(spreads, "amd_sssr/intersect", "radiance", 9, 3);
    add_failure(spreads, "amd_sssr/reproject", "variance", 36, 0);
    spreads.run.spread_pixels = 12, spreads.run.spread_frames = 2;
    add_failure(row(2, 3), "of_another_build/trace", "result", 5, 0);
    row(3, 1).run.negative = 7;
    row(2, 1).error = 0.75;
    row(3, 3).error.reset(), row(3, 3).run.refusal = "it has no \"black\"";
    for (StabilityRow& r : rows) r.verdict = verdict_of(r);
    std::filesystem::create_directories(folder);
    write_text(folder / "stability_cases.csv", stability_cases_csv(cases));
    write_text(folder / "stability.csv", stability_csv(rows));
    write_text(folder / "stability_stages.csv", stability_stages_csv(rows, true));
}
