#include "tests/experiments/report/report_stability_fixture.h"

#include "experiments/results/stability/stability_rows.h"

namespace {

StabilityCaseName made_up_case(const std::string& name, const std::string& group, const std::string& why) {
    StabilityCaseName result;
    result.name = result.family = name, result.group = group, result.why = why;
    return result;
}

StabilityRow made_up_row(const StabilityCaseName& what, const std::string& technique, const std::string& point) {
    StabilityRow row;
    row.case_name = what.name, row.group = what.group, row.technique = technique, row.point = point;
    set_errors(row, 0.25, 0.2);
    return row;
}

/// `nan` and `infinite` values in one image, of which the first that is added is where they arise.
void add_failure(StabilityRow& row, const std::string& stage, const std::string& image, size_t nan, size_t infinite) {
    row.stages.push_back({.stage = stage, .image = image, .nan = nan, .infinite = infinite, .largest = 2});
    row.non_finite += nan + infinite;
    if (row.first_non_finite.empty()) row.first_non_finite = stage + ": " + image;
}

}  // namespace

void write_stability_fixture(const std::filesystem::path& folder) {
    const std::vector<StabilityCaseName> cases = {
        made_up_case("plain", "plain", "what the others are compared with"),
        made_up_case("bad hit lit nan", "faults", "whose <b>result</b> is it in?"),
        made_up_case("far away", "depth", "codes of depth end"), made_up_case("black", "radiance", "0 / 0"),
        made_up_case("one pixel", "sizes", "no level to halve")};
    std::vector<StabilityRow> rows;
    for (const StabilityCaseName& c : cases)
        for (const auto& [technique, point] :
             {std::pair("path_tracer", "default"), std::pair("amd_sssr", "slides"), std::pair("amd_sssr", "corrected"),
              std::pair("of_another_build", "default")})
            rows.push_back(made_up_row(c, technique, point));
    const auto row = [&](size_t c, size_t technique) -> StabilityRow& { return rows[c * 4 + technique]; };
    for (const size_t technique : {1u, 2u, 3u}) {
        StabilityRow& r = row(0, technique);
        r.depth_median = 300.0 / double(technique), r.depth_p999 = 9e4;
        r.normal_median = 1, r.normal_p999 = 20, r.lit_median = 0, r.lit_p999 = 3;
    }
    StabilityRow& spreads = row(1, 1);
    add_failure(spreads, "amd_sssr/intersect", "radiance", 9, 3);
    add_failure(spreads, "amd_sssr/reproject", "variance", 36, 0);
    spreads.spread_pixels = 12, spreads.spread_frames = 2;
    add_failure(row(2, 3), "of_another_build/trace", "result", 5, 0);
    row(3, 1).negative = 7;
    set_errors(row(2, 1), 0.75, 0.2);
    set_errors(row(3, 3), std::nullopt, 0.2), row(3, 3).refusal = "it has no \"black\"";
    for (StabilityRow& r : rows) r.verdict = verdict_of(r);
    std::filesystem::create_directories(folder);
    write_rows(folder / "stability_cases.csv", cases);
    write_rows(folder / "stability.csv", rows);
    write_rows(folder / "stability_stages.csv", stage_rows(rows, true));
}
