#include "experiments/study/shots/shot_cells.h"
#include "core/elapsed.h"
#include "core/error.h"
#include "core/in_flight.h"
#include "core/number_text.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/results/cells/provenance.h"
#include "experiments/study/config/points/conditions.h"
#include "experiments/study/measuring/costs/costs.h"
#include "experiments/study/measuring/costs/gpu_estimates.h"
#include "experiments/study/measuring/rehearsal.h"
#include "experiments/study/measuring/times/clock_proofs.h"
#include "experiments/study/measuring/times/timing.h"
#include "experiments/study/measuring/times/timing_lock.h"
#include "experiments/study/shots/external_frames.h"
#include "experiments/study/shots/open_shot.h"
#include "experiments/study/shots/point_renders.h"
#include "experiments/study/shots/told_results.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <set>
#include <span>

namespace {

/// A cell that is to be done.
struct CellTask {
    const PlannedCell& planned;
    std::function<Cell(const std::function<void(double)>& report)> make;
    /// Of a cell that was there and was tried once more.
    std::function<bool(const Cell& again, const Cell& before)> is_better = [](const Cell&, const Cell&) {
        return true;
    };
};

bool is_of_another_machine(const StudySession& study, const Cell& cell) {
    return cell.provenance.at("host") != study.maker.at("host");
}

/// Why times that are there are taken once more; "" if they are not.
std::string why_timed_again(const StudySession& study, const Cell& cell) {
    if (study.settings.takes_times_here && is_of_another_machine(study, cell))
        return "its times are another machine's; they are taken here";
    return study.settings.takes_times_again && disturbed_share(cell.timing) > 0
               ? "its times were disturbed by other programs; they are taken again, and the less disturbed kept"
               : "";
}

/// Why a cell that is there is tried once more; "" if it is not. The better of both is kept.
std::string why_again(const StudySession& study, CellKind kind, const Cell& cell) {
    if (kind == CellKind::times) return why_timed_again(study, cell);
    const std::string refusal = refusal_in(cell.compiled) + refusal_in(cell.estimates);
    return refusal.empty() ? "" : "a compiler is asked again that gave no numbers (" + refusal + ")";
}

/// Times are kept whatever machine took them, which nobody is to overlook.
void say_whose_times(StudySession& study, const PlannedCell& planned, const Cell& cell) {
    if (planned.kind == CellKind::times && is_of_another_machine(study, cell))
        study.progress.say(
            "note: " + planned.what + " are those of " + cell.provenance["host"]["name"].get<std::string>() + " (" +
            cell.provenance["host"]["cpu"].get<std::string>() + "); --times-here takes them on this machine");
}

/// The cell if it was done before, of this truth (of any, if none is given).
std::optional<Cell> load_cell(const StudySession& study, const PlannedCell& planned,
                              const std::optional<std::string>& truth) {
    std::optional<Cell> cell = study.cells.load(planned.name);
    if (cell && truth && cell->truth != *truth) return {};
    return cell;
}

/// Loads the cell if it was done before, else does it and keeps it. Nothing if another process is at it, unless
/// `waits`.
std::optional<Cell> do_cell(StudySession& study, const CellTask& task, const std::optional<std::string>& truth,
                            bool waits) {
    const PlannedCell& planned = task.planned;
    // References were rendered when the shot was opened.
    study.work.start(name_of(planned.kind), kind_of_work(planned),
                     planned.kind == CellKind::references ? 0 : planned.units);
    study.report(0, planned.what);
    std::optional<Cell> found = load_cell(study, planned, truth);
    const bool is_tried_again = found && !why_again(study, planned.kind, *found).empty();
    if (found && !is_tried_again) {
        study.work.found(found->seconds);
        say_whose_times(study, planned, *found);
        return found;
    }
    const auto claim = study.cells.claim(planned.name, waits);
    if (!claim) return {};
    found = load_cell(study, planned, truth);  // another may have made it since
    const std::string why = found ? why_again(study, planned.kind, *found) : "";
    if (found && why.empty()) {
        study.work.found(found->seconds);
        return found;
    }
    if (found) study.progress.say("note: " + planned.what + ": " + why);
    const std::string started = time_stamp();
    const auto start = std::chrono::steady_clock::now();
    const SpentTime::Span span(study.spent, name_of(planned.kind));
    Cell cell = task.make([&](double share) { study.report(share, planned.what); });
    cell.name = planned.name, cell.seconds += seconds_since(start);
    cell.provenance = cell_provenance(study.maker, planned.what, started);
    const bool is_kept = !found || task.is_better(cell, *found);
    if (is_kept) {
        const SpentTime::Span saving(study.spent, "cells");
        study.cells.save(planned.name, cell);
    }
    ++study.made;
    study.work.finish();
    return is_kept ? std::move(cell) : std::move(*found);
}

/// The proof of the clock, made or loaded once in a process.
const ClockProof& proven_clock(StudySession& study) {
    if (study.clock) return *study.clock;
    study.clock = kept_clock_proof(study.settings.cache, study.maker, [&] { return prove_clock(study.device); });
    if (study.clock->verdict() == ClockVerdict::failed)
        study.progress.say(
            "warning: timer validation failed: passes of 1 : 10 : 100 work took other times on a quiet machine, "
            "so no time of this run can be trusted");
    if (study.clock->verdict() == ClockVerdict::not_judged)
        study.progress.say(
            "warning: the timer was not validated: passes of 1 : 10 : 100 work took other times while other programs "
            "were at work on this machine");
    return *study.clock;
}

/// What the times of a shot may take: a share of what its other cells took. Where one of these is not in the folder, as
/// another machine makes it, that is not known, and the times take what they take.
double timing_budget(const StudySession& study, const PlannedShot& shot) {
    double seconds = 0;
    for (const PlannedCell& planned : shot.cells) {
        if (planned.kind == CellKind::times) continue;
        const std::optional<Cell> cell = study.cells.read(planned.name);
        if (!cell) return std::numeric_limits<double>::infinity();
        seconds += cell->seconds;
    }
    return study.config.timing.most_share * seconds;
}

/// What was wrong with the machine while times were taken; "" if it was quiet.
std::string disturbance(const TimingLoad& load) {
    if (load.disturbed == 0) return "";
    const std::string stolen =
        load.stolen > 0.01 ? " (other virtual machines took up to " + fixed_text(100 * load.stolen) + " % of its time)"
                           : "";
    return "other programs disturbed " + std::to_string(load.disturbed) + " of " + std::to_string(load.frames) +
           " timed frames" + stolen + ", which are marked; `--times-again` takes these times once more";
}

/// All times of a shot, while no other ssrlab takes any on this machine.
Cell timing_cell(StudySession& study, OpenShot& open, double budget, const std::function<void(double)>& report) {
    const TimingLock lock([&](const std::string& text) { study.progress.say(text); });
    const ClockProof& clock = proven_clock(study);
    const auto lit = [&](unsigned frame) -> const HostImage& { return open.truth.lit({.frame = frame}); };
    const ShotTimes times = time_techniques(*open.source, open.shot, config_on(study.config, open.shot), lit,
                                            study.settings.keep_all, budget, report);
    if (const std::string why = disturbance(times.load); !why.empty())
        study.progress.say("warning: " + open.shot.name() + ": " + why);
    Cell cell;
    cell.times = times.rows, cell.timing = timing_entry(times, open.shot.name(), clock);
    return cell;
}

Cell renders_cell(StudySession& study, OpenShot& open, const PlannedCell& planned,
                  const std::function<void(double)>& report) {
    const PointSettings settings{.out = study.settings.out,
                                 .image_suffix = planned.name.substr(0, 8),
                                 .keep_all = study.settings.keep_all,
                                 .report = report,
                                 .spent = study.spent};
    if (planned.technique->external)
        return measure_external(open.shot, open.truth, study.config, *planned.technique, settings);
    return render_point(study.device, open.shot, open.truth, *open.store, study.config, *planned.technique, settings);
}

/// Forms for GPUs are those of all devices for most techniques: what is counted for estimates is then counted for all.
Cell costs_cell(StudySession& study, OpenShot& open, const PlannedCell& planned,
                const std::function<void(double)>& report) {
    const auto lit = [&](const FrameStep& step) -> const HostImage& { return open.truth.lit(step); };
    const bool keep_all = study.settings.keep_all, counts = study.config.counts_costs;
    const PointConfig& point = *planned.technique;
    const std::string shot = open.shot.name();
    const auto count = [&] { return count_costs(study.device, open.shot, *open.store, lit, point, keep_all, report); };
    Cell cell;
    if (study.config.gpu_compilers.empty()) {
        cell.costs = count();
        return cell;
    }
    std::optional<TracedFrame> frame;
    if (counts) try {
            frame = trace_last_frame(study.device, open.shot, *open.store, lit, point, keep_all, report);
        } catch (const MachineError&) {
            throw;
        } catch (const Error& e) {  // a shader that cannot be traced
            cell.estimates = refused_estimates(e.what(), shot, point, study.plan.compilers);
        }
    const ChipCompilation how{.cache = study.settings.cache,
                              .notice = [&](const std::string& text) { study.progress.say("warning: " + text); }};
    cell.compiled = compiled_rows(
        frame ? frame->pipelines : stage_pipelines(study.device, open.shot, *open.store, lit, point, keep_all), shot,
        point, study.plan.compilers, how);
    if (!counts) return cell;
    if (frame) cell.estimates = estimate_rows(*frame, shot, point, study.plan.compilers, how);
    cell.costs = frame && !frame->is_of_gpu_forms ? cost_rows(frame->costs, shot, point) : count();
    return cell;
}

Cell make_cell(StudySession& study, OpenShot& open, const PlannedShot& shot, const PlannedCell& planned,
               const std::function<void(double)>& report) {
    switch (planned.kind) {
        case CellKind::references:
            return references_cell(open);
        case CellKind::renders:
            return renders_cell(study, open, planned, report);
        case CellKind::costs:
            return costs_cell(study, open, planned, report);
        case CellKind::times:
            return timing_cell(study, open, timing_budget(study, shot), report);
    }
    fail("no cell is made of kind ", int(planned.kind));
}

/// How a cell of an open shot is made.
CellTask task_of(StudySession& study, OpenShot& open, const PlannedShot& shot, const PlannedCell& planned) {
    CellTask task{.planned = planned, .make = {}};
    const auto make = [&study, &open, &shot, &planned](const auto& report) {
        const InFlightText technique(in_flight().technique, planned.technique ? planned.technique->technique : ""),
            point(in_flight().point, planned.technique ? planned.technique->point : "");
        Cell cell = make_cell(study, open, shot, planned, report);
        cell.truth = open.truth.content_hash();
        return cell;
    };
    task.make = make;
    if (planned.kind != CellKind::times) return task;
    task.is_better = [&study](const Cell& again, const Cell& before) {
        return disturbed_share(again.timing) < disturbed_share(before.timing) ||
               (study.settings.takes_times_here && is_of_another_machine(study, before));
    };
    return task;
}

/// The cells if all of them were done before and none is to be tried again.
std::optional<std::vector<Cell>> load_finished(StudySession& study, const std::vector<const PlannedCell*>& planned) {
    const SpentTime::Span span(study.spent, "loading cells");
    std::vector<Cell> cells;
    for (const PlannedCell* p : planned) {
        std::optional<Cell> cell = study.cells.load(p->name);
        if (!cell || !why_again(study, p->kind, *cell).empty()) return {};
        if (!cells.empty() && cell->truth != cells.front().truth) return {};
        cells.push_back(std::move(*cell));
    }
    for (size_t i = 0; i < planned.size(); ++i) {
        study.work.start(name_of(planned[i]->kind), kind_of_work(*planned[i]), planned[i]->units);
        study.work.found(cells[i].seconds);
        say_whose_times(study, *planned[i], cells[i]);
    }
    return cells;
}

std::unique_ptr<OpenShot> opened(StudySession& study, const PlannedShot& shot) {
    const SpentTime::Span span(study.spent, name_of(CellKind::references));
    const PlannedCell& references = shot.cells.front();
    study.work.start(name_of(CellKind::references), kind_of_work(references), references.units);
    const auto start = std::chrono::steady_clock::now();
    std::unique_ptr<OpenShot> open =
        open_shot(study.device, shot.config, study.config,
                  {.out = study.settings.out,
                   .cache = study.settings.cache,
                   .search_path = study.settings.search_path,
                   .keep_all = study.settings.keep_all,
                   .say = [&](const std::string& text) { study.progress.say(text); },
                   .report = [&](double share, const std::string& what) { study.report(share, what); }});
    open->opening_seconds = seconds_since(start);
    open->has_rendered_references ? study.work.finish() : study.work.found(0);
    return open;
}

/// A scene's warnings are told once: by who makes the references of its first shot.
void say_scene_warnings(StudySession& study, const PlannedShot& shot, const PlannedCell& first) {
    if (first.kind != CellKind::references || std::filesystem::exists(study.cells.file(first.name))) return;
    for (const std::string& warning : shot.scene_warnings) study.progress.say("warning: " + warning);
}

/// The points of which some cell is not there.
std::vector<PointConfig> points_to_do(const StudySession& study) {
    std::set<const PointConfig*> missing;
    for (const PlannedShot& shot : study.plan.shots)
        for (const PlannedCell& cell : shot.cells)
            if (cell.technique && !std::filesystem::exists(study.cells.file(cell.name))) missing.insert(cell.technique);
    std::vector<PointConfig> points;
    for (const PointConfig& point : study.config.techniques)
        if (missing.contains(&point)) points.push_back(point);
    return points;
}

/// Compiles all that the study has yet to render, so that a mistake in a shader is told before hours of work. Once in a
/// process.
void rehearse_once(StudySession& study) {
    if (study.is_rehearsed) return;
    const SpentTime::Span span(study.spent, compiling);
    const auto start = std::chrono::steady_clock::now();
    rehearse(study.device, points_to_do(study));
    study.work.add_overhead(seconds_since(start));
    study.is_rehearsed = true;
}

}  // namespace

void do_cells(StudySession& study, const PlannedShot& shot, const CellSelection& selection,
              const std::function<void()>& rendered) {
    std::vector<const PlannedCell*> planned;
    for (const PlannedCell& cell : shot.cells)
        if (selection.holds(cell)) planned.push_back(&cell);
    if (planned.empty()) return;
    if (std::optional<std::vector<Cell>> all = load_finished(study, planned)) {
        std::ranges::move(*all, std::back_inserter(study.finished));
        return;
    }
    say_scene_warnings(study, shot, *planned.front());
    rehearse_once(study);
    const bool is_told = study.plan.shots.size() <= most_told_shots;
    if (is_told) study.progress.say(shot.name);
    const std::unique_ptr<OpenShot> open = opened(study, shot);
    const std::string truth = open->truth.content_hash();
    const size_t before = study.finished.size();
    std::vector<bool> is_done(planned.size());
    for (const bool waits : {false, true})
        for (size_t i = 0; i < planned.size(); ++i) {
            if (is_done[i]) continue;
            std::optional<Cell> cell = do_cell(study, task_of(study, *open, shot, *planned[i]), truth, waits);
            if (!cell) continue;
            if (is_told) say_result(study, *cell);
            const size_t place = before + size_t(std::count(is_done.begin(), is_done.begin() + ptrdiff_t(i), true));
            study.finished.insert(study.finished.begin() + ptrdiff_t(place), std::move(*cell));
            is_done[i] = true;
            if (i > 0 && is_done.front()) rendered();
        }
    if (!is_told) say_results(study, shot.name, std::span(study.finished).subspan(before));
}
