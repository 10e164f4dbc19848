#include "tests/experiments/report/report_fixture.h"

#include "core/exr/exr.h"
#include "core/files.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/evaluation.h"
#include "experiments/results/files/manifest.h"

#include <cmath>
#include <random>
#include <vector>

namespace {

using nlohmann::json;

struct Point {
    std::string technique, point;
    double noise, missing, milliseconds;  ///< noise of the radiance, share of the floor that finds nothing, time
};

const Point points[] = {{"none", "default", 0.0, 1.0, 0.0},
                        {"mcguire_dda", "stride=1", 0.02, 0.1, 6.5},
                        {"mcguire_dda", "stride=4", 0.05, 0.25, 2.1}};

std::string shown_name(const Point& p) { return p.technique + "_" + p.point; }

glm::vec3 wall(double u, double v) {
    const double stripe = std::sin(u * 40.0) > 0.3 ? 1.0 : 0.15;
    return glm::vec3(0.9, 0.5 + 0.4 * u, 0.2) * float(stripe) + glm::vec3(0.1, 0.2, 0.5) * float(v);
}

/// The floor is the lower half; it mirrors the wall. `specular` is what it reflects, `image` adds the wall and a dull
/// floor.
glm::vec3 pixel(const Point* p, bool is_image, double u, double v, std::mt19937& random) {
    const auto uniform = [&] { return std::generate_canonical<double, 32>(random); };
    const bool is_floor = v > 0.5;
    glm::vec3 specular(0);
    if (is_floor) {
        const bool finds_nothing = p && std::fmod(u * 7.0 + v * 3.0, 1.0) < p->missing;
        specular = finds_nothing ? glm::vec3(0.3f) : wall(u, 1.0 - v) * 0.7f;
        const double noise = p ? (finds_nothing ? 0.0 : p->noise) : 0.004;
        specular += glm::vec3(noise * (uniform() - 0.5) * 4.0);
    }
    const glm::vec3 diffuse = is_floor ? glm::vec3(0.05f) : wall(u, v);
    return is_image ? specular + diffuse : specular;
}

HostImage picture(const Point* p, bool is_image, glm::uvec2 extent, unsigned seed) {
    std::mt19937 random(seed + 1);
    HostImage image(extent, 3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            image.set_rgb(size_t(y) * extent.x + x,
                          pixel(p, is_image, (x + 0.5) / extent.x, (y + 0.5) / extent.y, random));
    return image;
}

double mean_squared_error(const HostImage& a, const HostImage& b, size_t first_pixel) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = first_pixel * 3; i < a.values.size(); ++i) {
        const double d = a.values[i] - b.values[i];
        if (std::isfinite(d)) sum += d * d, ++count;
    }
    return sum / double(count);
}

/// Only `mse` is the images' own; the other metrics are made from it, since no test looks at their meaning.
void add_rows(Cell& cell, ResultRow row, const HostImage& result, const HostImage& truth, size_t non_finite) {
    for (const auto& [mask, first_pixel] :
         {std::pair("all", size_t(0)), std::pair("reflective", truth.pixel_count() / 2)}) {
        const double mse = mean_squared_error(result, truth, first_pixel);
        struct Value {
            const char *metric, *formula;
            double value;
            bool corrected;
        };
        for (const Value& m :
             {Value{"mse", "mse", mse, true}, Value{"relmse", "relmse_a", mse * 2.5, true},
              Value{"flip", "ldr_flip", std::sqrt(mse), false},
              Value{"ssim", "ssim_gauss11", 1.0 - std::sqrt(mse), false}, Value{"bias", "bias", -mse / 3, true}}) {
            row.mask = mask, row.metric = m.metric, row.formula = m.formula, row.value = m.value,
            row.corrected = m.corrected, row.uncorrected = m.value * 1.02;
            row.low = row.high = std::nullopt;
            if (m.corrected)
                row.low = m.value - 0.04 * std::abs(m.value), row.high = m.value + 0.05 * std::abs(m.value);
            row.floor = 0.0004, row.pixels = truth.pixel_count() - first_pixel, row.non_finite = non_finite;
            cell.results.push_back(row);
        }
    }
}

void add_times(Cell& cell, const std::string& shot, const Point& p, unsigned seed) {
    std::mt19937 random(seed + 77);
    for (unsigned frame = 0; frame < 15; ++frame) {
        const double jitter = 1.0 + 0.1 * std::generate_canonical<double, 32>(random);
        const double trace = 0.8 * p.milliseconds * jitter, shade = 0.2 * p.milliseconds * jitter;
        for (const auto& [stage, time] : {std::pair("mcguire_dda/trace", trace), std::pair("mcguire_dda/shade", shade),
                                          std::pair("total", trace + shade)})
            if (p.milliseconds > 0)
                cell.times.push_back({shot, p.technique, p.point, seed, stage, frame, time, "host_fence"});
        if (p.technique == "none" && seed == 0)
            for (const auto& [stage, time] :
                 {std::pair("gbuffer/raster", 11.0 * jitter), std::pair("lit", 0.4 * jitter)})
                cell.times.push_back({shot, "", "", 0, stage, frame, time, "host_fence"});
    }
}

json image_entry(const std::string& shot, const std::string& technique, const std::string& point, const char* kind,
                 const char* target, unsigned seed, const std::string& exr) {
    return {{"shot", shot}, {"technique", technique}, {"point", point}, {"seed", seed},
            {"kind", kind}, {"target", target},       {"exr", exr}};
}

Cell make_cell(const std::filesystem::path& folder, const std::string& shot, glm::uvec2 extent, const Point& p,
               unsigned seed) {
    Cell cell;
    ResultRow row{.shot = shot,
                  .scene = shot.substr(0, shot.find('.')),
                  .camera = "front",
                  .frame = "0",
                  .width = extent.x,
                  .height = extent.y,
                  .technique = p.technique,
                  .point = p.point,
                  .seed = seed};
    for (const char* target : {"specular", "image"}) {
        const bool is_image = std::string(target) == "image";
        HostImage result = picture(&p, is_image, extent, seed);
        const bool has_nan = shot == fixture_shots[1] && p.point == "stride=4";
        if (has_nan) result.values[3 * (extent.x * 60 + 20)] = NAN;
        const HostImage truth = picture(nullptr, is_image, extent, 4711);
        row.target = target;
        add_rows(cell, row, result, truth, has_nan ? 1 : 0);
        const std::string exr =
            "images/" + shot + "/" + shown_name(p) + "_" + std::to_string(seed) + "_" + target + ".exr";
        write_exr(folder / exr, result, PixelType::half);
        cell.images.push_back(image_entry(shot, p.technique, p.point, "result", target, seed, exr));
    }
    add_times(cell, shot, p, seed);
    return cell;
}

/// What the viewer shows of a pixel beside its values: of the truth roughness and a rung of its ladder, which knows
/// three quarters of what arrives; of the techniques confidence, and verdicts that are right on the left, and hits of
/// what is not there on the right.
void add_pixel_images(const std::filesystem::path& folder, const std::string& shot, glm::uvec2 extent, json& images) {
    const auto add = [&](const std::string& name, const HostImage& image, json entry) {
        const std::string exr = "images/" + shot + "/" + name + ".exr";
        write_exr(folder / exr, image, PixelType::half);
        entry["shot"] = shot, entry["exr"] = exr;
        images.push_back(entry);
    };
    const auto made = [&](const auto& color) {
        HostImage image(extent, 3);
        for (unsigned i = 0; i < image.pixel_count(); ++i) image.set_rgb(i, color(i % extent.x));
        return image;
    };
    const auto constant = [&](float value) { return made([&](unsigned) { return glm::vec3(value); }); };
    const auto truth = [](const char* kind, const char* target) {
        return json{{"technique", "reference"}, {"kind", kind}, {"target", target}};
    };
    add("reference_incident", constant(1.0f), truth("reference", "incident"));
    add("reference_on_screen", constant(0.75f), truth("reference", "on_screen"));
    add("roughness", made([&](unsigned x) { return glm::vec3(float(x) / float(extent.x)); }),
        truth("surface", "roughness"));
    const glm::vec3 right(0, 158, 115), false_hit(204, 121, 167);  // as map_of_verdicts() has them
    const HostImage verdicts = made([&](unsigned x) {
        const bool has_ray = x % 4 != 3;  // else that of its 2 x 2 pixels counts
        return has_ray ? glm::pow((x < extent.x / 2 ? right : false_hit) / 255.0f, glm::vec3(2.2f)) : glm::vec3(0);
    });
    for (const Point& p : points) {
        const json of_point = {{"technique", p.technique}, {"point", p.point}, {"seed", 0}};
        json confidence = of_point, hits = of_point;
        confidence["kind"] = confidence["target"] = "confidence";
        hits["kind"] = "hits", hits["target"] = "mcguire_dda/trace";
        add(shown_name(p) + "_confidence", constant(p.missing == 1.0 ? 0.0f : 0.6f), confidence);
        if (p.missing < 1.0) add(shown_name(p) + "_hits", verdicts, hits);
    }
}

json new_shot_entry(const std::string& shot, glm::uvec2 extent) {
    const bool falls_short = shot == fixture_shots[2];
    return {{"shot", shot},
            {"scene", shot.substr(0, shot.find('.'))},
            {"camera", "front"},
            {"frame", 0},
            {"width", extent.x},
            {"height", extent.y},
            {"exposure_ev", 0.5},
            {"lit", "path_traced"},
            {"warnings", json::array()},
            {"needs",
             json::array({{{"fact", "has_reflective"}, {"value", "yes"}, {"why", "material 'mirror' has roughness 0"}},
                          {{"fact", "objects_move"}, {"value", "no"}, {"why", "nothing is animated"}}})},
            {"left_out", json::array({{{"what", "gbuffer/previous_frame"},
                                       {"fact", "objects_move"},
                                       {"why", "nothing moves"},
                                       {"saved_ms", nullptr}}})},
            {"reference",
             {{"hash", "0123456789abcdef0123456789abcdef"},
              {"samples_median", 1024},
              {"seconds", 12.5},
              {"rays", 4.2e7},
              {"max_depth", 64},
              {"target_relative_error", 0.03},
              {"from_cache", false},
              {"relative_error", {{"median", 0.021}, {"p95", 0.06}, {"mean", 0.03}}},
              {"reached_share", falls_short ? 0.6204 : 1.0},
              {"non_finite_samples", 0}}}};
}

json manifest_head() {
    const auto check = [](const char* kind, const char* verdict, double third) {
        return json{{"stage_kind", kind},          {"expected", {1, 10, 100}}, {"measured_ms", {0.1, 1.0, third / 10}},
                    {"ratio", {1.0, 10.0, third}}, {"foreign_load", 0.01},     {"attempts", 1},
                    {"verdict", verdict}};
    };
    json techniques = json::array();
    for (const Point& p : points) {
        json parameters = json::object();
        if (p.technique != "none")
            parameters = {{"stride", p.point == "stride=1" ? 1 : 4}, {"thickness", 0.1}, {"jitter", true}};
        techniques.push_back({{"technique", p.technique},
                              {"point", p.point},
                              {"title", p.technique == "none" ? "No reflections" : "McGuire & Mara 2014"},
                              {"source", p.technique == "none" ? "" : "JCGT 3(4)"},
                              {"parameters", parameters}});
        if (p.point == "stride=1") techniques.back()["limits"] = "WebGL 2";
    }
    const json maker = {
        {"ssrlab",
         {{"version", "0.1.0"},
          {"commit", "abcdef0123456789"},
          {"dirty", false},
          {"compiler", "GNU 12.2"},
          {"build", "Release"}}},
        {"started", "2026-01-31T12:00:00Z"},
        {"finished", "2026-01-31T12:05:00Z"},
        {"device",
         {{"name", "llvmpipe (LLVM 15.0.6, 256 bits)"},
          {"driver", "Mesa 22.3.6"},
          {"api", "1.3.230"},
          {"type", "cpu"}}},
        {"host", {{"name", "a"}, {"cpu", "A processor"}, {"cores", 4}, {"memory_gib", 22.5}, {"kernel", "Linux 6.1"}}},
        {"cells",
         {{{"cell", "0123456789abcdef"},
           {"what", fixture_shots[0] + ": mcguire_dda stride=1"},
           {"started", "2026-01-31T12:00:00Z"},
           {"finished", "2026-01-31T12:01:00Z"}}}}};
    return {{"provenance", {maker}},
            {"is_complete", true},
            {"title", "Linear tracing </script> against the truth"},
            {"warnings", {"a clause that the study has to say"}},
            {"clock",
             {{"aa_floors", {{fixture_shots[0], 0.02}, {fixture_shots[1], 0.02}}},
              {"aa_pairs",
               {{{"shot", fixture_shots[0]},
                 {"technique", "mcguire_dda"},
                 {"point", "stride=4"},
                 {"first_ms", 2.1},
                 {"second_ms", 2.9},
                 {"floor", 0.34}}}},
              {"load", {{{"shot", fixture_shots[1]}, {"disturbed_frames", 3}, {"largest_foreign_load", 0.2}}}},
              {"savings",
               {{{"shot", fixture_shots[0]},
                 {"technique", "mcguire_dda"},
                 {"point", "default"},
                 {"complete_ms", 8.0},
                 {"share", 0.25},
                 {"low", 0.2},
                 {"high", 0.3}}}},
              {"proofs",
               {{{"method", "host_fence"},
                 {"empty_submit_ms", 0.21},
                 {"verdict", "failed"},
                 {"shots", {fixture_shots[0], fixture_shots[1], fixture_shots[2]}},
                 {"checks", {check("compute", "passed", 101.0), check("fragment", "failed", 31.0)}}}}}}},
            {"metrics", metric_descriptions()},
            {"techniques", techniques},
            {"shots", json::array()},
            {"images", json::array()}};
}

}  // namespace

void write_report_fixture(const std::filesystem::path& folder) {
    json manifest = manifest_head();
    std::vector<Cell> cells;
    for (const std::string& shot : fixture_shots) {
        const glm::uvec2 extent = shot == fixture_shots[2] ? glm::uvec2(161, 91) : glm::uvec2(160, 90);
        manifest["shots"].push_back(new_shot_entry(shot, extent));
        for (const char* target : {"specular", "image"}) {
            const std::string exr = "images/" + shot + "/reference_" + target + ".exr";
            write_exr(folder / exr, picture(nullptr, std::string(target) == "image", extent, 4711));
            manifest["images"].push_back(image_entry(shot, "reference", "", "reference", target, 0, exr));
        }
        for (const Point& p : points)
            for (const unsigned seed : {0u, 1u}) {
                cells.push_back(make_cell(folder, shot, extent, p, seed));
                for (const json& image : cells.back().images) manifest["images"].push_back(image);
            }
        if (shot == fixture_shots[0]) add_pixel_images(folder, shot, extent, manifest["images"]);
    }
    StudyResults study{rows_of(cells), manifest};
    evaluate(study, {}, {});
    write_tables(folder, study);
    write_text(folder / "manifest.json", manifest.dump(1));
}
