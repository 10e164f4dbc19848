#include "tests/experiments/report/report_shots_fixture.h"

#include "core/exr/exr.h"
#include "core/files.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_results.h"

#include <cmath>

namespace {

using nlohmann::json;

constexpr size_t shot_points = 20;

PointName point_name(size_t i) {
    return i == 0 ? PointName("none", "default")
                  : PointName("technique_" + std::to_string(i % 5), "preset_" + std::to_string(i));
}

/// Values that differ in all digits, as measured ones do.
double value_of(size_t shot, size_t point) { return 0.1 * (2 + std::sin(double(7 * shot + 3 * point))); }

void add_errors(const std::string& shot, size_t s, StudyResults& study) {
    for (size_t p = 0; p < shot_points; ++p)
        for (const char* target : {"specular", "image"})
            for (const char* metric : {"mse", "flip"})
                for (const char* mask : {"reflective", "roughness_0_0.1", "roughness_0.1_0.3"}) {
                    MetricSummary e{.shot = shot, .frame = "0"};
                    std::tie(e.technique, e.point) = point_name(p);
                    e.target = target, e.metric = e.formula = metric, e.mask = mask;
                    e.seeds = 2, e.pixels = 500, e.ranked = e.corrected = e.represents_shot = true;
                    e.interval = interval::reference_and_seeds, e.seed_deviation = 0.01, e.floor = 1e-4;
                    e.value = value_of(s, p), e.low = 0.9 * *e.value, e.high = 1.1 * *e.value;
                    e.standing = p == 1 ? standing::best : standing::behind;
                    study.summary.push_back(e);
                }
}

void add_splits_and_rays(const std::string& shot, size_t s, StudyResults& study) {
    for (size_t p = 1; p < shot_points; ++p) {
        const auto [technique, point] = point_name(p);
        const double value = value_of(s, p);
        study.splits.push_back({shot,
                                "0",
                                technique,
                                point,
                                "specular",
                                "reflective",
                                2,
                                value,
                                0.7 * value,
                                0.3 * value,
                                0.2 * value,
                                0.4 * value,
                                500,
                                0.6 * value,
                                0.8 * value,
                                {},
                                {}});
        const auto add = [&](const std::string& stage, const char* quantity, double share) {
            study.hits.push_back({.shot = shot,
                                  .frame = "0",
                                  .technique = technique,
                                  .point = point,
                                  .stage = stage,
                                  .mask = "reflective",
                                  .quantity = quantity,
                                  .seeds = 1,
                                  .rays = 100,
                                  .value = share,
                                  .low = {},
                                  .high = {}});
        };
        for (const auto& [quantity, share] : {std::pair("right", 0.5), {"avoidable_miss", 0.25}, {"empty", 0.25}})
            add(technique + "/trace", quantity, share);
        add(technique + "/trace", "correct", 0.75), add(technique + "/trace", "fetches", 12.5);
        for (const auto& [quantity, share] : {std::pair("error: right", value), {"error: avoidable_miss", 1 - value}})
            add("error", quantity, share);
    }
}

void add_times(const std::string& shot, size_t s, StudyResults& study) {
    for (size_t p = 1; p < shot_points; ++p)
        for (const char* stage : {"trace", "filter", "resolve", "total"}) {
            const auto [technique, point] = point_name(p);
            const double ms = value_of(s, p + shot_points) * (stage[1] == 'o' ? 3 : 1);
            study.time_summary.push_back({shot, technique, point,
                                          stage == std::string("total") ? stage : technique + "/" + stage, "host_fence",
                                          15, ms, 0.9 * ms, 1.1 * ms, 1.1 * ms, 0.9 * ms, 0});
        }
}

json images_of(const std::filesystem::path& folder, const std::string& shot) {
    json images = json::array();
    for (size_t p = 0; p < 3; ++p) {  // the third is the truth
        const auto [technique, point] = point_name(p);
        const std::string exr = "images/" + shot + "/" + std::to_string(p) + ".exr";
        write_exr(folder / exr, HostImage({2, 2}, 3, 0.25f * float(p)));
        json image = {{"shot", shot}, {"frame", 0}, {"seed", 0}, {"target", "specular"}, {"exr", exr}};
        image["kind"] = p == 2 ? "reference" : "result";
        image["technique"] = p == 2 ? "reference" : technique;
        if (p < 2) image["point"] = point;
        images.push_back(image);
    }
    return images;
}

}  // namespace

void write_shots_fixture(const std::filesystem::path& folder, size_t shots) {
    StudyResults study;
    study.manifest = {{"title", "Many shots"},
                      {"primary", {{"metric", "mse"}, {"mask", "reflective"}, {"target", "specular"}}},
                      {"is_complete", true},
                      {"metrics", metric_descriptions()},
                      {"images", json::array()}};
    for (size_t p = 0; p < shot_points; ++p) {
        const auto [technique, point] = point_name(p);
        study.manifest["techniques"].push_back(
            {{"technique", technique}, {"point", point}, {"parameters", json::object()}, {"depends_on_seed", p > 0}});
    }
    for (size_t s = 0; s < shots; ++s) {
        const std::string scene = "room_" + std::to_string(s), shot = scene + ".main.32x18";
        study.manifest["shots"].push_back(
            {{"shot", shot}, {"scene", scene}, {"frames", {0}}, {"frame", 0}, {"exposure_ev", 0.0}});
        add_errors(shot, s, study);
        add_splits_and_rays(shot, s, study);
        add_times(shot, s, study);
        for (const json& image : images_of(folder, shot)) study.manifest["images"].push_back(image);
    }
    write_tables(folder, study);
    write_text(folder / "manifest.json", study.manifest.dump(1));
}
