#include "core/files.h"
#include "experiments/measuring/timing.h"
#include "experiments/measuring/timing_lock.h"
#include "experiments/results/host_info.h"
#include "experiments/results/provenance.h"
#include "experiments/study/config/conditions.h"
#include "experiments/study/point_run.h"
#include "experiments/study/study_run.h"
#include "variants/registry.h"

#include <algorithm>
#include <map>

namespace {

/// The name of a cell: the hash of all that its numbers depend on.
std::string cell_hash(const StudyRun& study, const ShotRun& run, const std::string& what,
                      const nlohmann::json& parameters, const std::vector<unsigned>& seeds) {
    const Config& c = study.config;
    const ShotConfig& shot = run.shot.config;
    ContentHash hash;
    for (const std::string& part :
         {study.code, study.device.info().name + study.device.info().driver, run.shot.scene.content_hash,
          run.shot.name(), run.truth.content_hash(), what, parameters.dump()})
        hash.add(part);
    for (const auto& list : {c.metrics, c.masks, c.targets, c.frame_metrics, c.frame_masks}) {
        hash.add(list.size());
        for (const std::string& name : list) hash.add(name);
    }
    for (const auto& list :
         {shot.frames,
          seeds,
          {shot.warm_up, shot.repeat, shot.change.value_or(0), unsigned(shot.measures_last_only), shot.measure_from}}) {
        hash.add(list.size());
        for (const unsigned number : list) hash.add(number);
    }
    hash.add(int(shot.direct_lit)), hash.add(int(shot.depth_format)), hash.add(int(shot.depth_direction)),
        hash.add(int(study.settings.keep_all)), hash.add(int(c.composite)), hash.add(shot.normal_bits);
    hash.add(c.hits ? int(c.hits->every) : 0), hash.add(c.hits ? int(c.hits->seeds) : 0);
    hash.add(c.reflective_max_roughness), hash.add(c.reflective_min_reflectance), hash.add(run.shot.camera.exposure_ev);
    return hash.hex();
}

/// A piece of work with a name of its own.
struct CellTask {
    std::string hash, what, kind;
    double units;
    std::function<Cell(const std::function<void(double)>& report)> make;
    /// Why a cell that is there is tried once more; "" if it is not. The better of both is kept.
    std::function<std::string(const Cell&)> why_again = [](const Cell&) { return ""; };
    std::function<bool(const Cell& again, const Cell& before)> is_better = [](const Cell&, const Cell&) {
        return true;
    };
};

/// A result while the study runs: one number that matters, over the seeds.
void say_result(StudyRun& study, const Cell& cell) {
    const PrimaryComparisons& shown = study.config.primary;
    std::map<std::string, std::vector<double>> values;  // by frame
    size_t non_finite = 0;                              // pixels, of the worst seed
    for (const ResultRow& r : cell.rows)
        if (r.target == shown.target && r.metric == shown.metric && r.mask == shown.mask && r.value)
            values[r.frame].push_back(*r.value), non_finite = std::max(non_finite, size_t(r.non_finite));
    if (values.empty()) return;
    const auto& [frame, seeds] = values.contains(over_frames) ? *values.find(over_frames) : *values.rbegin();
    double sum = 0;
    for (const double value : seeds) sum += value;
    char line[240];
    std::snprintf(line, sizeof line, "  %-56s %s of %s pixels %.4g (%s, %zu seed%s)",
                  display_name(study.config, cell.rows.front().variant, cell.rows.front().point).c_str(),
                  shown.metric.c_str(), shown.mask.c_str(), sum / double(seeds.size()),
                  frame == over_frames ? "over all frames" : ("frame " + frame).c_str(), seeds.size(),
                  seeds.size() == 1 ? "" : "s");
    const std::string left_out =
        non_finite > 0 ? ", without " + std::to_string(non_finite) + " that are not finite" : "";
    study.progress.say(line + left_out);
}

/// Loads the cell if it was done before, else does it and keeps it. Nothing if another process is at it, unless
/// `waits`.
std::optional<Cell> do_cell(StudyRun& study, const CellTask& task, bool waits) {
    study.work.start(task.kind, task.units);
    study.report(0, task.what);
    std::optional<Cell> found = study.cells.load(task.hash);
    const bool is_tried_again = found && !task.why_again(*found).empty();
    if (found && !is_tried_again) {
        study.work.skip();
        return found;
    }
    const auto claim = study.cells.claim(task.hash, waits);
    if (!claim) return {};
    found = study.cells.load(task.hash);  // another may have made it since
    const std::string why = found ? task.why_again(*found) : "";
    if (found && why.empty()) {
        study.work.skip();
        return found;
    }
    if (found) study.progress.say("note: " + task.what + ": " + why);
    const std::string started = time_stamp();
    Cell cell = task.make([&](double share) { study.report(share, task.what); });
    cell.name = task.hash;
    cell.provenance = cell_provenance(study.maker, task.what, started);
    const bool is_kept = !found || task.is_better(cell, *found);
    if (is_kept) study.cells.save(task.hash, cell);
    study.work.finish();
    return is_kept ? std::move(cell) : std::move(*found);
}

/// All variant points of a shot.
std::vector<CellTask> point_tasks(StudyRun& study, ShotRun& run) {
    std::vector<CellTask> tasks;
    for (const VariantConfig& variant : study.config.variants) {
        if (!runs_on(variant, run.shot)) continue;
        const nlohmann::json parameters =
            make_variant(variant.variant, variant.parameters, variant.preset)->params.values();
        // Times do not depend on which images are kept, and the cells of points do: these have them.
        const std::string what =
            variant.variant + "\n" + variant.point + (study.config.keeps_all_images ? "\nall images" : "");
        CellTask task{.hash = cell_hash(study, run, what, parameters, variant.seeds),
                      .what = run.shot.name() + ": " + variant.variant + " " + variant.point,
                      .kind = "frames",
                      .units = double(run.shot.steps.size() * variant.seeds.size())};
        task.make = [&study, &run, &variant, suffix = task.hash.substr(0, 8)](const auto& report) {
            return run_point(study.device, run.shot, run.truth, run.store, study.config, variant,
                             {.out = study.settings.out,
                              .image_suffix = suffix,
                              .keep_all = study.settings.keep_all,
                              .report = report});
        };
        tasks.push_back(std::move(task));
    }
    return tasks;
}

bool has_times(const Config& config) {
    return config.timing.frames > 0 && std::ranges::any_of(config.variants, &VariantConfig::is_timed);
}

/// The proof of the clock, made once in a process.
const ClockProof& proven_clock(StudyRun& study) {
    if (study.clock) return *study.clock;
    study.clock = prove_clock(study.device);
    if (study.clock->verdict() == ClockVerdict::failed)
        study.progress.say(
            "warning: the clock did not prove itself: passes of 1 : 10 : 100 work took other times on a quiet machine, "
            "so no time of this run can be trusted");
    if (study.clock->verdict() == ClockVerdict::not_judged)
        study.progress.say(
            "warning: the clock could not be judged: passes of 1 : 10 : 100 work took other times while other programs "
            "were at work on this machine");
    return *study.clock;
}

/// All times of a shot, while no other ssrlab takes any on this machine.
Cell timing_cell(StudyRun& study, ShotRun& run, const std::function<void(double)>& report) {
    const Config config = config_on(study.config, run.shot);
    if (!has_times(config)) return {};
    const TimingLock lock([&](const std::string& text) { study.progress.say(text); });
    const ClockProof& clock = proven_clock(study);
    const auto lit = [&](unsigned frame) -> const HostImage& { return run.truth.lit({.frame = frame}); };
    const ShotTimes times = time_variants(run.source, run.shot, config, lit, study.settings.keep_all, report);
    if (times.load.disturbed > 0)
        study.progress.say("warning: " + run.shot.name() + ": other programs disturbed " +
                           std::to_string(times.load.disturbed) + " of " + std::to_string(study.config.timing.frames) +
                           " timed frames; the next run takes these times again");
    return Cell{.times = times.rows, .timing = timing_entry(times, run.shot.name(), clock)};
}

double disturbed_frames(const Cell& cell) { return cell.timing.at("load").at("disturbed_frames").get<double>(); }

CellTask timing_task(StudyRun& study, ShotRun& run) {
    const Config config = config_on(study.config, run.shot);
    const nlohmann::json what = timed_work(config, study.manifest["variants"], study.maker["host"]);
    std::vector<unsigned> seeds;
    for (const VariantConfig& variant : config.variants) seeds.push_back(variant.seeds.front());
    return {.hash = cell_hash(study, run, "times", what, seeds),
            .what = run.shot.name() + ": timing",
            .kind = "times",
            .units = 1,
            .make = [&study, &run](const auto& report) { return timing_cell(study, run, report); },
            .why_again = [](const Cell& cell) -> std::string {
                return is_disturbed(cell.timing) ? "its times were disturbed by other programs; they are taken again"
                                                 : "";
            },
            .is_better = [](const Cell& again,
                            const Cell& before) { return disturbed_frames(again) < disturbed_frames(before); }};
}

}  // namespace

void run_cells(StudyRun& study, ShotRun& run) {
    std::vector<CellTask> tasks = point_tasks(study, run);
    tasks.push_back(timing_task(study, run));
    std::vector<std::optional<Cell>> cells(tasks.size());
    for (const bool waits : {false, true})
        for (size_t i = 0; i < tasks.size(); ++i) {
            if (cells[i]) continue;
            cells[i] = do_cell(study, tasks[i], waits);
            if (cells[i]) say_result(study, *cells[i]);
        }
    for (std::optional<Cell>& cell : cells) study.finished.push_back(std::move(*cell));
}
