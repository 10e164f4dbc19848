#include "experiments/study/run.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/json.h"
#include "experiments/measuring/rung_errors.h"
#include "experiments/measuring/timing.h"
#include "experiments/report/report.h"
#include "experiments/report/report_points.h"
#include "experiments/results/effects.h"
#include "experiments/results/host_info.h"
#include "experiments/results/manifest.h"
#include "experiments/results/provenance.h"
#include "experiments/results/results.h"
#include "experiments/results/results_schema.h"
#include "experiments/results/time_effects.h"
#include "experiments/study/capture.h"
#include "experiments/study/config/conditions.h"
#include "experiments/study/folder_owner.h"
#include "experiments/study/rehearsal.h"
#include "experiments/study/stale_files.h"
#include "experiments/study/study_run.h"
#include "groundtruth/reference_cache.h"

#include <set>

namespace {

// First guesses of seconds, for a small study; what is measured replaces them (workload.h).
constexpr double reference_guess = 20, frame_guess = 0.2, timing_guess = 5;

/// Device memory for G-buffers that are kept: 32 frames of 480x270 take half of it.
constexpr size_t max_stored_bytes = size_t(1) << 30;

/// Loads each shot once before any work starts, to refuse what could not be told apart in the results.
void plan_work(StudyRun& study) {
    std::set<std::string> names;
    for (const ShotConfig& config : study.config.shots) {
        const std::string name = config.gbuffer.empty() ? load_shot(config, study.settings.search_path).name()
                                                        : capture_name(config.gbuffer) + config.name_suffix;
        if (!names.insert(name).second)
            fail("two shots are called '", name,
                 "': they differ in nothing that results are named by; give them other frames, another camera or "
                 "another resolution");
        study.work.plan("reference", double(config.frames.size()), reference_guess);
        for (const VariantConfig& variant : study.config.variants)
            study.work.plan("frames", double(timeline(config).size() * variant.seeds.size()), frame_guess);
        if (study.config.timing.frames > 0) study.work.plan("times", 1, timing_guess);
    }
}

/// Renders the reference of one frame, or takes it from the cache. Targets are of the last frame, so that only its
/// reference needs a truth ladder.
Reference obtain_reference(StudyRun& study, const Shot& shot, unsigned frame, ReferenceUse use) {
    const ShotFrame now = shot_frame(shot, frame);
    ReferenceSettings settings = study.config.reference;
    settings.keep_all = study.settings.keep_all;
    settings.ladder = use.is_of_last && needs_ladder(study.config);
    ReferenceRun run;
    run.progress = [&](double fraction, double rays_per_second, double) {
        char rate[32];
        std::snprintf(rate, sizeof rate, "%.1f Mray/s", rays_per_second * 1e-6);
        study.report(fraction, shot.name() + ": reference of frame " + std::to_string(frame) + ", " + rate);
    };
    run.notice = [&](const std::string& text) { study.progress.say("note: " + text); };
    study.work.start("reference", 1);
    Reference reference =
        cached_reference(shot.scene, now.scene, now.camera, shot.config.extent, settings, study.settings.cache, run);
    reference.from_cache ? study.work.skip() : study.work.finish();
    return reference;
}

/// The shot's entry in the manifest, from the G-buffer of its last frame.
void enter_shot(StudyRun& study, ShotRun& run, const std::vector<std::string>& notes) {
    const FrameStep& last = run.shot.steps.back();
    const FrameStore::Frame frame = run.store.frame(last, run.truth.lit(last));
    const HostGBuffer host =
        download_gbuffer(run.source.graph(), frame.gbuffer, frame.camera, run.shot.config.depth_format);
    nlohmann::json entry = shot_entry(run.shot, pixel_facts(host), study.config, study.settings.keep_all);
    for (const VariantConfig& v : study.config.variants)
        if (const std::string why = why_skipped(v, run.shot); !why.empty())
            study.manifest["skipped"].push_back(
                {{"shot", run.shot.name()}, {"variant", v.variant}, {"point", v.point}, {"condition", why}});
    entry.update(run.reference_entries);
    if (run.truth.is_measured()) {
        const FlipExposures& flip = run.truth.pose(last).flip_exposures;
        entry["flip_exposures"] = {flip.start, flip.stop, flip.count};
        if (needs_ladder(study.config))
            entry["truth_ladder"] = rung_entries(run.truth.pose(last), run.truth.frame(last)->masks);
    } else {
        entry["lit"] = study.config.has_reference ? "file" : "direct";
        entry["warnings"].push_back(
            study.config.has_reference
                ? "This G-buffer came without a reference: its results are rendered and timed, not measured."
                : "The study asks for no reference: no error is measured.");
    }
    for (const std::string& note : notes) entry["warnings"].push_back(note);
    study.manifest["shots"].push_back(std::move(entry));
}

/// What no metric can tell once techniques have read it. Frames that nothing asked for are not counted.
void enter_non_finite(StudyRun& study, const ShotRun& run) {
    nlohmann::json& entry = study.manifest["shots"].back();
    entry["gbuffer_non_finite"] = run.store.non_finite();
    for (const auto& [layer, count] : run.store.non_finite()) {
        const std::string warning = "The G-buffer holds " + std::to_string(count) + " values of '" + layer +
                                    "' that are NaN or infinite: every result of this shot has read them.";
        entry["warnings"].push_back(warning);
        study.progress.say("warning: " + run.shot.name() + ": " + warning);
    }
}

/// Keeps for the manifest what is worth knowing of a reference, and writes its images if they are kept.
void note_reference(StudyRun& study, ShotRun& run, const Reference& reference, unsigned frame, ReferenceUse use) {
    nlohmann::json entry = reference_entry(reference, frame, study.config);
    for (const nlohmann::json& warning : entry["warnings"])
        study.progress.say("warning: " + run.shot.name() + ", frame " + std::to_string(frame) + ": " +
                           warning.get<std::string>());
    run.reference_entries["references"].push_back(std::move(entry));
    if (use.is_of_last) run.reference_entries["reference"] = run.reference_entries["references"].back();
    if (use.is_of_last || (study.config.keeps_all_images && use.is_of_measured))
        run.reference_images[frame] =
            save_reference_images(study.settings.out, run.shot.name(), frame, reference, run.shot.camera.exposure_ev);
}

/// Lists the images of the references, and writes those of the surfaces, of each frame whose results are kept. Frames
/// that look alike share the files.
void enter_truth_images(StudyRun& study, const ShotRun& run) {
    for (const FrameStep& step : run.shot.steps) {
        const FrameTruth* truth = run.truth.frame(step);
        const bool is_kept = &step == &run.shot.steps.back() || (study.config.keeps_all_images && step.is_measured);
        if (!truth || !is_kept) continue;
        for (const auto& [frame, images] : run.reference_images) {
            if (run.truth.poses.at(frame) != truth->pose) continue;
            for (nlohmann::json image : images) {
                image["frame"] = step.frame;
                study.manifest["images"].push_back(std::move(image));
            }
        }
        study.manifest["images"].push_back(
            save_roughness_image(study.settings.out, run.shot.name(), step.frame, truth->roughness));
    }
}

void run_scene_shot(StudyRun& study, const ShotConfig& config) {
    const Shot shot = load_shot(config, study.settings.search_path);
    study.progress.say(shot.scene.name + ", camera " + shot.camera.name);
    const std::unique_ptr<FrameSource> source = scene_source(study.device, shot, study.config, study.settings.keep_all);
    ShotRun run{
        .shot = shot, .source = *source, .store = FrameStore(*source, shot.config.depth_format, max_stored_bytes)};
    unsigned references = 0;
    if (!study.config.has_reference)
        run.truth = truth_of_lit(shot, {});
    else
        run.truth = shot_truth(shot, study.config, run.store, source->graph(), [&](unsigned frame, ReferenceUse use) {
            Reference reference = obtain_reference(study, shot, frame, use);
            note_reference(study, run, reference, frame, use);
            ++references;
            return reference;
        });
    study.work.plan("reference", double(references) - double(config.frames.size()),
                    reference_guess);  // the others look the same
    enter_truth_images(study, run);
    enter_shot(study, run, {});
    run_cells(study, run);
    enter_non_finite(study, run);
}

/// A capture: measured if it comes with a reference, else only rendered and timed.
void run_gbuffer_shot(StudyRun& study, const ShotConfig& config) {
    LoadedGBuffer loaded = load_gbuffer(config.gbuffer);
    const Shot shot = gbuffer_shot(config, loaded.gbuffer);
    study.progress.say(shot.scene.name + ", from files");
    for (const std::string& note : loaded.notes) study.progress.say("note: " + note);
    study.work.plan("reference", -1, reference_guess);  // read, not rendered
    std::optional<Reference> reference;
    if (!config.reference.empty())
        reference = read_capture_reference(config.reference, loaded.gbuffer, needs_ladder(study.config));
    // A reference brings the path-traced lit colour; `ssrlab gbuffer` saves unshadowed direct light.
    if (reference && !config.direct_lit) loaded.gbuffer.lit = {};
    ShotTruth lit_alone =
        truth_of_lit(shot, loaded.gbuffer.lit.values.empty() ? HostImage{} : channels_of(loaded.gbuffer.lit, 0, 3));
    const std::unique_ptr<FrameSource> source = file_source(study.device, std::move(loaded.gbuffer));
    ShotRun run{
        .shot = shot, .source = *source, .store = FrameStore(*source, shot.config.depth_format, max_stored_bytes)};
    run.truth = std::move(lit_alone);
    if (reference) {
        run.truth = shot_truth(shot, study.config, run.store, source->graph(), [&](unsigned frame, ReferenceUse use) {
            note_reference(study, run, *reference, frame, use);
            return *reference;
        });
    }
    enter_truth_images(study, run);
    enter_shot(study, run, loaded.notes);
    run_cells(study, run);
    enter_non_finite(study, run);
}

/// Lists what earlier versions of the study left in the folder, or removes it.
void handle_stale_files(const StudyRun& study, nlohmann::json& manifest) {
    std::set<std::string> used;
    for (const Cell& cell : study.finished) used.insert(cell.name);
    const std::filesystem::path& out = study.settings.out;
    const StaleFiles stale = find_stale_files(out, study.cells, used, manifest, study.manifest_before);
    if (stale.is_empty()) return;
    if (study.settings.prunes) return remove_stale_files(out, study.cells, stale);
    manifest["stale"] = {{"cells", stale.cells}, {"images", stale.images}};
}

/// The report reads all images of all shots so far: of a long study's time no more than about a twentieth goes into it.
bool is_report_due(const StudyRun& study) {
    return std::chrono::steady_clock::now() - study.report_made > 20 * study.report_took;
}

std::vector<ShotAnswer> make_report(StudyRun& study) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<ShotAnswer> answers = write_report(study.settings.out);
    study.report_made = std::chrono::steady_clock::now(), study.report_took = study.report_made - start;
    return answers;
}

/// Writes what is finished so far, so that a long study can be read while it runs. Returns what the report says of each
/// shot; nothing where it was not made.
std::vector<ShotAnswer> write_results(StudyRun& study, bool is_last) {
    nlohmann::json manifest = study.manifest;
    const StudyRows rows = rows_of(study.finished);
    for (const Cell& cell : study.finished) {
        for (const nlohmann::json& entry : cell.images) manifest["images"].push_back(entry);
        for (const std::string& note : cell.notes) manifest["notes"].push_back(note);
        if (!cell.timing.is_null()) add_timing(manifest, cell.timing);
    }
    manifest["provenance"] = provenance_entries(study.finished);
    manifest["is_complete"] = is_last;
    manifest["written"] = {{"ssrlab", study.maker["ssrlab"]}, {"at", time_stamp()}};
    if (is_last) handle_stale_files(study, manifest);
    write_text(study.settings.out / "manifest.json", manifest.dump(1) + "\n");
    write_tables(study.settings.out, rows);
    write_parameters(study.settings.out, study.config.variants);
    const auto not_repeatable = points_not_repeatable(study.manifest);
    const std::vector<VariantConfig>& variants = study.config.variants;
    std::vector<EffectRow> effects = paired_effects(rows.results, variants, not_repeatable, rows.reference_noise);
    std::ranges::move(split_effects(rows.splits, variants, not_repeatable), std::back_inserter(effects));
    set_families(effects, study.config.primary);
    write_rows(study.settings.out / "effects.csv", effects);
    write_rows(study.settings.out / "time_effects.csv", time_effects(rows.times, variants));
    std::vector<ShotAnswer> answers;
    if (is_last || is_report_due(study)) answers = make_report(study);
    if (is_last && manifest.contains("stale"))
        study.progress.say("note: " + std::to_string(manifest["stale"]["cells"].size()) + " cells and " +
                           std::to_string(manifest["stale"]["images"].size()) +
                           " images of earlier versions of this study stay in " + study.settings.out.string() +
                           "; --prune removes them");
    return answers;
}

/// What a run before left, which may be of any version; null if it cannot be read.
nlohmann::json read_manifest_before(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    try {
        return read_json(file);
    } catch (const MachineError&) {
        throw;
    } catch (const Error&) {
        return {};
    }
}

/// What a reader wants to know first.
void say_answers(StudyRun& study, const std::vector<ShotAnswer>& answers) {
    for (const ShotAnswer& answer : answers)
        study.progress.say("\n" + answer.shot + ": " + answer.sentence +
                           (answer.perceptual_sentence.empty() ? "" : " " + answer.perceptual_sentence));
}

}  // namespace

void run_study(const Config& config, const RunSettings& settings) {
    Device device(settings.device);
    Progress progress(1.0);
    const auto say = [&](const std::string& text) { progress.say(text); };
    const nlohmann::json maker = maker_of_cells(device);
    StudyRun study{.config = config,
                   .settings = settings,
                   .device = device,
                   .cells = CellStore(settings.out, say),
                   .progress = progress,
                   .work = {},
                   .code = maker["ssrlab"]["code"],
                   .maker = maker,
                   .manifest = study_entry(config),
                   .manifest_before = {},
                   .clock = {},
                   .finished = {}};
    for (const auto& warning : study.manifest["warnings"]) study.progress.say("warning: " + warning.get<std::string>());
    plan_work(study);
    const FolderOwner owner(settings.out, config, settings.keep_all, settings.replaces, say);
    rehearse(device, config.variants);
    study.manifest_before = read_manifest_before(settings.out / "manifest.json");
    std::vector<ShotAnswer> answers;
    for (const ShotConfig& shot : config.shots) {
        if (shot.gbuffer.empty())
            run_scene_shot(study, shot);
        else
            run_gbuffer_shot(study, shot);
        answers = write_results(study, &shot == &config.shots.back());
    }
    say_answers(study, answers);
    study.progress.say("\nReport: " +
                       std::filesystem::absolute(settings.out / "report.html").lexically_normal().string());
}
