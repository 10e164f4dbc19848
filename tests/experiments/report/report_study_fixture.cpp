// Over 400 lines: one made-up study, every part of which the report shows beside the others.
#include "tests/experiments/report/report_study_fixture.h"

#include "core/exr/exr.h"
#include "core/files.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/evaluation.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/interval.h"

#include <random>
#include <vector>

namespace {

using nlohmann::json;

struct StudyPoint {
    std::string technique, point;
    double error;  ///< relative to the baseline's
    unsigned seeds;
    json parameters;
    std::string not_repeatable = "";  ///< why
};

json parameters(bool float_histories, bool round_up_tiles, bool race) {
    return {{"float_histories", float_histories}, {"round_up_tiles", round_up_tiles}, {"race", race}, {"form", "fast"}};
}

const StudyPoint study_points[] = {{"none", "default", 3.0, 1, json::object()},
                                   {"sssr", "first", 1.0, 4, parameters(false, false, false)},
                                   {"sssr", "fixed", 0.5, 4, parameters(true, true, false)},
                                   {"sssr", "first float_histories=true", 0.6, 4, parameters(true, false, false)},
                                   {"sssr", "first round_up_tiles=true", 1.0, 4, parameters(false, true, false)},
                                   {"sssr", "first race=true", 0.7, 4, parameters(false, false, true), "it races"},
                                   {"sssr", "lucky", 0.1, 1, parameters(false, true, true)}};

struct StudyShot {
    std::string name;
    std::vector<unsigned> frames;
    unsigned repeat;
};

std::vector<StudyShot> study_shots() {
    std::vector<StudyShot> shots;
    for (const char* scene : {"still_a", "still_b", "still_c", "still_d", "still_e"})
        shots.push_back({scene + std::string(".main.160x90.w8.r8"), {0}, 8});
    shots.push_back({study_moving_shot, {3, 4, 5, 6}, 1});
    shots.push_back({study_step_shot, {}, 1});
    for (unsigned frame = 29; frame < 45; ++frame) shots.back().frames.push_back(frame);
    return shots;
}

/// Errors of the seeds scatter by about 1 %; equal for equal seeds, whatever the point.
double scatter(const std::string& shot, unsigned seed) {
    std::mt19937 random(unsigned(std::hash<std::string>()(shot)) + seed * 7919u);
    return 1.0 + 0.02 * (std::generate_canonical<double, 32>(random) - 0.5);
}

struct RowMaker {
    const StudyShot& shot;
    const StudyPoint& point;
    unsigned seed;
    Cell& cell;

    void add(const std::string& frame, const char* target, const char* metric, const char* formula,
             const std::string& mask, std::optional<double> value) const {
        ResultRow r{.shot = shot.name,
                    .scene = shot.name.substr(0, shot.name.find('.')),
                    .camera = "main",
                    .frame = frame,
                    .width = 160,
                    .height = 90,
                    .technique = point.technique,
                    .point = point.point,
                    .seed = seed,
                    .target = target,
                    .metric = metric,
                    .formula = formula,
                    .mask = mask,
                    .value = value,
                    .corrected = true,
                    .uncorrected = value,
                    .pixels = 500};
        if (value) r.low = *value - 0.03 * std::abs(*value), r.high = *value + 0.03 * std::abs(*value);
        cell.results.push_back(r);
    }

    /// `factor` differs between masks, frames and metrics.
    double error(double factor) const { return 0.1 * factor * point.error * scatter(shot.name, seed); }
};

void add_errors(const RowMaker& make) {
    const bool has_frames = make.shot.frames.size() > 1;
    const std::string last = std::to_string(make.shot.frames.back()), representative = has_frames ? over_frames : last;
    make.add(representative, "specular", "mse", "mse", "reflective", make.error(0.01 * make.point.error));
    double factor = 1.0;
    for (const char* mask : {"reflective", "roughness_0_0.03", "roughness_0.03_0.3", "roughness_0.3_0.6"}) {
        make.add(representative, "specular", "relmse", "relmse_a", mask, make.error(factor));
        if (has_frames) make.add(last, "specular", "relmse", "relmse_a", mask, make.error(factor * 1.7));
        make.add(last, "incident", "bias", "bias", mask, -make.error(factor * 0.3));
        factor *= 1.4;
    }
    for (size_t i = 0; has_frames && i + 1 < make.shot.frames.size(); ++i)
        make.add(std::to_string(make.shot.frames[i]), "specular", "relmse", "relmse_a", "reflective",
                 make.error(2.0 / double(i + 1)));
}

void add_temporal(const RowMaker& make) {
    const auto add = [&](const char* metric, const char* formula, std::optional<double> value) {
        make.add(over_frames, "specular", metric, formula, "reflective", value);
    };
    if (make.shot.repeat > 1) add("flicker_relative", "temporal_variance_a", make.error(0.001));
    if (make.shot.frames.size() > 1) {
        add("frame_difference_relative", "frame_difference_a", make.error(0.4));
        if (make.shot.name != study_step_shot)
            make.add(over_frames, "specular", "relmse", "relmse_a", "disoccluded", make.error(5.0));
    }
    if (make.shot.name != study_step_shot) return;
    const bool is_without_ghosts = make.point.technique == "none" || make.point.point == "first round_up_tiles=true";
    add("ghost_length", "ghost_projection_0.05", is_without_ghosts ? 0.0 : 6.0);
    if (make.point.point != "fixed") add("settling_length", "squared_error_step_0.05", 3.0);
    if (make.point.point == "fixed") add("settling_length", "squared_error_step_0.05", std::nullopt);
}

void add_split(const StudyShot& shot, const StudyPoint& point, Cell& cell) {
    if (point.seeds < 2) return;
    const double variance = 0.001 * point.error, bias = point.point == "fixed" ? -1e-5 : 0.05 * point.error;
    cell.splits.push_back({shot.name, std::to_string(shot.frames.back()), point.technique, point.point, "specular",
                           "reflective", point.seeds, bias + variance, bias, variance, 0.8 * variance, 1.2 * variance,
                           500, bias - 2e-5, bias + 3e-5});
    SplitRow& row = cell.splits.back();
    for (unsigned j = 0; j < point.seeds; ++j) {
        row.seed_numbers.push_back(j);
        for (unsigned i = 0; i < j; ++i) {
            row.pairs.variance.push_back(variance * scatter(shot.name + point.point, 10 * i + j));
            row.pairs.bias_squared.push_back(bias * scatter(shot.name, 10 * i + j));
        }
    }
}

/// Ten stages: more than there are colours. `slowness` scales every frame's time a little differently.
void add_times(const StudyShot& shot, const StudyPoint& point, double slowness, Cell& cell) {
    for (unsigned frame = 0; frame < 15; ++frame) {
        double total = 0;
        for (unsigned stage = 0; stage < 10; ++stage) {
            const double time = (0.1 * (stage + 1) + 0.01 * frame) * (slowness + 0.001 * (frame * 7 % 15));
            cell.times.push_back(
                {shot.name, "sssr", point.point, 0, "sssr/stage_" + std::to_string(stage), frame, time, "host_fence"});
            total += time;
        }
        cell.times.push_back({shot.name, "sssr", point.point, 0, "total", frame, total, "host_fence"});
    }
}

/// Of the two stages that read, the second one twice as much.
void add_costs(const StudyShot& shot, const StudyPoint& point, Cell& cell) {
    for (const auto& [stage, fetches] :
         {std::pair("sssr/stage_0", 1'000'000), {"sssr/stage_1", 2'000'000}, {"total", 3'000'000}})
        for (const auto& [quantity, value] :
             {std::pair("fetches", fetches), {"bytes_read", 4 * fetches}, {"bytes_written", fetches}})
            cell.costs.push_back({shot.name, "sssr", point.point, stage, quantity, size_t(value)});
}

/// Two passes, by two chips; a compiler of one ended at the second pass of `fixed`. The first pass is the same machine
/// code in both points. All shots need the same passes but the step.
void add_compiled(const StudyShot& shot, const StudyPoint& point, Cell& cell) {
    const auto add = [&](const char* chip, const char* stage, double vgprs, double waves, const std::string& hash) {
        CompiledRow row;
        row.shot = shot.name, row.technique = point.technique, row.point = point.point, row.stage = stage;
        row.chip = chip, row.driver = "radv of a test";
        cell.compiled.push_back(row);
        if (chip[0] == 'g' && point.point == "fixed" && stage == std::string("sssr/stage_1")) {
            cell.compiled.back().refusal = "its compiler ended: <b>signal 9</b>";
            return;
        }
        CompiledRow& whole = cell.compiled.back();
        whole.shader = "compute", whole.lanes = 64, whole.vgprs = vgprs, whole.spilled_vgprs = 3, whole.waves = waves;
        whole.most_waves = 16, whole.limit = waves < 16 ? "registers" : "nothing", whole.inverse_throughput = 1234;
        whole.hash = hash;
    };
    for (const char* chip : {"navi21", "gfx1100"}) {
        add(chip, "sssr/stage_0", 24, 16, std::string(chip) + "0");
        add(chip, "sssr/stage_1", point.point == "first" ? 84 : 128, point.point == "first" ? 6 : 4,
            chip + point.point);
    }
    if (shot.name == study_step_shot) cell.compiled.front().vgprs = 32;
}

/// Two stages on two chips: memory bounds the first, which is twice as slow in the step, latency the second, which the
/// compiler of one chip refused of `fixed`. A third chip has no rates.
void add_estimates(const StudyShot& shot, const StudyPoint& point, Cell& cell) {
    const auto add = [&](const std::string& chip, const char* stage) -> EstimateRow& {
        EstimateRow row;
        row.shot = shot.name, row.technique = point.technique, row.point = point.point, row.stage = stage,
        row.chip = chip;
        return cell.estimates.emplace_back(row);
    };
    const double first = shot.name == study_step_shot ? 8 : 4, second = point.point == "first" ? 16 : 12;
    for (const auto& [chip, product] : {std::pair("navi21", "Card <A>"), {"gfx1100", "Card <B>"}}) {
        const auto add_time = [&](const char* stage, const char* bound, double memory, double latency) {
            EstimateRow& row = add(chip, stage);
            row.product = product, row.bound = bound, row.memory = memory, row.latency = latency;
            row.vector = 0.5, row.scalar = 0.25, row.shared_memory = 0, row.textures = 0.125, row.targets = 0;
            row.caches = 40, row.waves = 60, row.active_lanes = 0.75, row.unmatched = 0.125, row.cut_lanes = 0;
            row.microseconds = std::max(memory, latency);
            row.low = 0.75 * *row.microseconds, row.high = 1.25 * *row.microseconds;
        };
        add_time("sssr/stage_0", "memory", first, 0.5);
        if (chip == std::string("gfx1100") && point.point == "fixed") {
            add(chip, "sssr/stage_1").refusal = "its compiler ended: <b>signal 9</b>";
            add(chip, "total").refusal = "sssr/stage_1: its compiler ended: <b>signal 9</b>";
            continue;
        }
        add_time("sssr/stage_1", "latency", 1, second);
        add_time("total", "latency", first + 1, second + 0.5);
        EstimateRow& total = cell.estimates.back();
        total.microseconds = first + second, total.low = 0.75 * (first + second), total.high = 1.25 * (first + second);
    }
    add("vega20", "total").refusal = "ssrlab has no published rates of vega20";
}

/// Two passes, one of which traced rough surfaces only; two masks. The moving shot has two frames.
void add_hits(const StudyShot& shot, const StudyPoint& point, Cell& cell) {
    const auto add = [&](const std::string& frame, const char* stage, const char* mask, double right) {
        const auto add_row = [&](const char* quantity, double value, bool has_interval = true) {
            HitRow row{.shot = shot.name,
                       .frame = frame,
                       .technique = point.technique,
                       .point = point.point,
                       .stage = stage,
                       .mask = mask,
                       .quantity = quantity,
                       .seeds = point.seeds,
                       .rays = 1234.5,
                       .value = value,
                       .low = {},
                       .high = {}};
            if (has_interval) row.low = 0.9 * value, row.high = 1.1 * value;
            cell.hits.push_back(row);
        };
        add_row("right", right);
        add_row("wrong_place", 0.0625);
        add_row("false_hit", 0, false);
        add_row("avoidable_miss", 0.4375 - right);
        add_row("unavoidable_miss", 0.25);
        add_row("empty", 0.25);
        add_row("correct", right + 0.5);
        add_row("miss: too_thick", 0.25 * (0.4375 - right));
        add_row("miss: off_screen", 0.75 * (0.4375 - right));
        if (right > 0) add_row("distance_error", 0.00123, false);
        add_row("fetches", 17.25, false);
    };
    const std::string last = std::to_string(shot.frames.back());
    for (const char* mask : {"all", "reflective"}) {
        const double right = point.error * (mask[0] == 'a' ? 0.25 : 0.125);
        add(last, "sssr/trace_smooth", mask, right);
        add(last, "sssr/trace_rough", mask, 0);
        if (shot.name == study_moving_shot) add("3", "sssr/trace_smooth", mask, 0.5 * right);
    }
    // Shares of the squared error: the other point misses less.
    const double missed = point.point == "first" ? 0.375 : 0.125;
    for (const auto& [quantity, value] :
         {std::pair("right", 0.125), std::pair("unavoidable_miss", 0.1875), std::pair("empty", 0.0625),
          std::pair("avoidable_miss", missed), std::pair("wrong_place", 0.625 - missed)})
        cell.hits.push_back({.shot = shot.name,
                             .frame = last,
                             .technique = point.technique,
                             .point = point.point,
                             .stage = "error",
                             .mask = "reflective",
                             .quantity = std::string("error: ") + quantity,
                             .seeds = point.seeds,
                             .rays = 1234.5,
                             .value = value,
                             .low = {},
                             .high = {}});
}

json study_manifest(const std::vector<StudyShot>& shots) {
    json manifest = {
        {"title", "A study of changes"},
        {"primary", {{"metric", "relmse"}, {"mask", "reflective"}, {"target", "specular"}}},
        {"is_complete", true},
        {"metrics", metric_descriptions()},
        {"clock",
         {{"aa_floors", json::object()},
          {"aa_pairs", json::array()},
          {"proofs", json::array({{{"method", "host_fence"},
                                   {"verdict", "passed"},
                                   {"checks", json::array({{{"stage_kind", "compute"}, {"verdict", "passed"}}})}}})}}},
        {"notes",
         {study_step_shot +
          ": sssr fixed: no settling_length: not within the first half of 15 frames (all, reflective)"}},
        {"parameter_docs",
         {{"sssr", {{"float_histories", "keeps <b>32</b> bits & drifts less"}, {"round_up_tiles", "counts tiles"}}}}},
        {"images", json::array()}};
    for (const StudyShot& shot : shots) {
        json entry = {{"shot", shot.name}, {"frames", shot.frames}, {"frame", shot.frames.back()}};
        if (shot.name == study_step_shot) entry["change"] = 30;
        if (shot.name == study_moving_shot || shot.name == shots.front().name)
            for (const auto& [target, mask] :
                 {std::pair("specular", "all"), std::pair("specular", "reflective"), std::pair("image", "reflective")})
                entry["truth_ladder"].push_back({{"rung", "on_screen"},
                                                 {"target", target},
                                                 {"metric", "relmse"},
                                                 {"formula", "relmse_a"},
                                                 {"mask", mask},
                                                 {"value", 0.0123},
                                                 {"low", 0.0113},
                                                 {"high", 0.0133},
                                                 {"pixels", 500}});
        manifest["shots"].push_back(entry);
        manifest["clock"]["aa_floors"][shot.name] = 0.02;
        manifest["clock"]["aa_pairs"].push_back({{"shot", shot.name},
                                                 {"technique", "sssr"},
                                                 {"point", "first"},
                                                 {"first_ms", 6.2},
                                                 {"second_ms", 6.27},
                                                 {"floor", 0.0112}});
    }
    for (const StudyPoint& p : study_points) {
        manifest["techniques"].push_back({{"technique", p.technique},
                                          {"point", p.point},
                                          {"title", p.technique},
                                          {"source", ""},
                                          {"parameters", p.parameters},
                                          {"depends_on_seed", p.technique != "none"}});
        if (const size_t swept = p.point.find(' '); swept != std::string::npos) {
            const std::string name = p.point.substr(swept + 1, p.point.find('=') - swept - 1);
            manifest["techniques"].back()["single_change"] = {{"parameter", name}, {"value", p.parameters[name]}};
        }
        if (p.point == "lucky") manifest["techniques"].back()["label"] = "One lucky seed";
        if (!p.not_repeatable.empty()) manifest["techniques"].back()["not_repeatable"] = p.not_repeatable;
    }
    return manifest;
}

/// A rung of the truth ladder, and what is compared with it.
void add_rung_images(const std::filesystem::path& folder, const std::string& shot, json& images) {
    const auto add = [&](json entry, float value) {
        const std::string exr = "images/" + entry["kind"].get<std::string>() + ".exr";
        write_exr(folder / exr, HostImage({16, 9}, 3, value));
        entry["shot"] = shot, entry["exr"] = exr;
        images.push_back(entry);
    };
    add({{"technique", "reference"}, {"kind", "reference"}, {"target", "on_screen"}}, 0.25f);
    add({{"technique", "sssr"}, {"point", "first"}, {"seed", 0}, {"kind", "result"}, {"target", "incident"}}, 0.5f);
}

/// Images of every frame of a sequence, each darker than the one before; all but the last are only played.
void add_frame_images(const std::filesystem::path& folder, const std::string& shot, json& images) {
    for (unsigned frame = 3; frame <= 6; ++frame)
        for (const char* kind : {"reference", "result"}) {
            const bool is_truth = std::string(kind) == "reference";
            const std::string exr = "images/" + std::string(kind) + std::to_string(frame) + ".exr";
            write_exr(folder / exr, HostImage({16, 9}, 3, (is_truth ? 1.0f : 0.5f) / float(frame)));
            images.push_back({{"shot", shot},
                              {"frame", frame},
                              {"technique", is_truth ? "reference" : "sssr"},
                              {"point", is_truth ? "" : "first"},
                              {"seed", 0},
                              {"kind", frame < 6 ? "played" : kind},
                              {"target", "specular"},
                              {"exr", exr}});
        }
}

}  // namespace

void write_study_fixture(const std::filesystem::path& folder) {
    const std::vector<StudyShot> shots = study_shots();
    std::vector<Cell> cells;
    for (const StudyShot& shot : shots) {
        for (const StudyPoint& point : study_points) {
            Cell cell;
            for (unsigned seed = 0; seed < point.seeds; ++seed) {
                const RowMaker make{shot, point, seed, cell};
                add_errors(make);
                add_temporal(make);
            }
            add_split(shot, point, cell);
            if (point.point == "first" || point.point == "fixed") add_hits(shot, point, cell);
            if (point.point == "first" || point.point == "fixed") add_costs(shot, point, cell);
            if (point.point == "first" || point.point == "fixed") add_compiled(shot, point, cell);
            if (point.point == "first" || point.point == "fixed") add_estimates(shot, point, cell);
            if (point.point == "first") add_times(shot, point, 1, cell);
            if (point.point == "fixed") add_times(shot, point, 2, cell);
            cells.push_back(std::move(cell));
        }
    }
    std::vector<ComparedPoint> techniques;
    for (const StudyPoint& p : study_points) {
        ComparedPoint technique;
        technique.technique = p.technique, technique.point = p.point, technique.is_baseline = p.point == "first";
        technique.depends_on_seed = p.technique != "none";
        if (p.point == "fixed")
            technique.against = "float_histories=false", technique.against_point = "first round_up_tiles=true";
        techniques.push_back(technique);
    }
    json manifest = study_manifest(shots);
    add_rung_images(folder, shots.front().name, manifest["images"]);
    add_frame_images(folder, study_moving_shot, manifest["images"]);
    StudyResults study{rows_of(cells), manifest};
    evaluate(study, techniques, {.metric = "relmse", .mask = "reflective", .target = "specular"});
    write_tables(folder, study);
    write_text(folder / "manifest.json", manifest.dump(1));
}
