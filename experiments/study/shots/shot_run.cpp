#include "experiments/study/shots/shot_run.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "experiments/measuring/rung_errors.h"
#include "experiments/results/result_images.h"
#include "experiments/results/shot_facts.h"
#include "groundtruth/reference_cache.h"

#include <cstdio>
#include <map>

namespace {

/// Device memory for G-buffers that are kept: 32 frames of 480x270 take half of it.
constexpr size_t max_stored_bytes = size_t(1) << 30;

/// A shot while it is opened.
struct Opening {
    Device& device;
    const Config& config;
    const ShotRunSettings& settings;
    ShotRun& run;
    std::map<unsigned, std::vector<nlohmann::json>> reference_images = {};  ///< by the frame whose reference they are

    void warn(const std::string& text) {
        run.entry["warnings"].push_back(text);
        settings.say("warning: " + run.shot.name() + ": " + text);
    }
};

/// Renders the reference of one frame, or takes it from the cache. Targets are of the last frame, so that only its
/// reference needs a truth ladder.
Reference obtain_reference(const Opening& opening, unsigned frame, ReferenceUse use) {
    const Shot& shot = opening.run.shot;
    const ShotFrame now = shot_frame(shot, frame);
    ReferenceSettings settings = opening.config.reference;
    settings.keep_all = opening.settings.keep_all;
    settings.ladder = use.is_of_last && needs_ladder(opening.config);
    ReferenceRun run;
    run.progress = [&](double fraction, double rays_per_second, double) {
        char rate[32];
        std::snprintf(rate, sizeof rate, "%.1f Mray/s", rays_per_second * 1e-6);
        opening.settings.report(fraction, shot.name() + ": reference of frame " + std::to_string(frame) + ", " + rate);
    };
    run.notice = [&](const std::string& text) { opening.settings.say("note: " + text); };
    return cached_reference(shot.scene, now.scene, now.camera, shot.config.extent, settings, opening.settings.cache,
                            run);
}

/// Keeps for the manifest what is worth knowing of a reference, and writes its images if they are kept.
void note_reference(Opening& opening, const Reference& reference, unsigned frame, ReferenceUse use) {
    ShotRun& run = opening.run;
    nlohmann::json entry = reference_entry(reference, frame, opening.config);
    for (const nlohmann::json& warning : entry["warnings"])
        opening.settings.say("warning: " + run.shot.name() + ", frame " + std::to_string(frame) + ": " +
                             warning.get<std::string>());
    run.entry["references"].push_back(std::move(entry));
    if (use.is_of_last) run.entry["reference"] = run.entry["references"].back();
    if (use.is_of_last || (opening.config.keeps_all_images && use.is_of_measured))
        opening.reference_images[frame] =
            save_reference_images(opening.settings.out, run.shot.name(), frame, reference, run.shot.camera.exposure_ev);
}

/// Lists the images of the references, and writes those of the surfaces, of each frame whose results are kept. Frames
/// that look alike share the files.
void enter_truth_images(Opening& opening) {
    ShotRun& run = opening.run;
    for (const FrameStep& step : run.shot.steps) {
        const FrameTruth* truth = run.truth.frame(step);
        const bool is_kept = &step == &run.shot.steps.back() || (opening.config.keeps_all_images && step.is_measured);
        if (!truth || !is_kept) continue;
        for (const auto& [frame, images] : opening.reference_images) {
            if (run.truth.poses.at(frame) != truth->pose) continue;
            for (nlohmann::json image : images) {
                image["frame"] = step.frame;
                run.images.push_back(std::move(image));
            }
        }
        run.images.push_back(save_roughness_image(opening.settings.out, run.shot.name(), step.frame, truth->roughness));
    }
}

/// What the manifest says of the shot that its G-buffers and its truth tell.
void enter_shot(Opening& opening) {
    ShotRun& run = opening.run;
    const FrameStep& last = run.shot.steps.back();
    const FrameStore::Frame frame = run.store->frame(last, run.truth.lit(last));
    const HostGBuffer host =
        download_gbuffer(run.source->graph(), frame.gbuffer, frame.camera, run.shot.config.depth_format);
    run.entry["needs"] = fact_entries(list_facts(pixel_facts(host)));
    if (run.truth.is_measured()) {
        const FlipExposures& flip = run.truth.pose(last).flip_exposures;
        run.entry["flip_exposures"] = {flip.start, flip.stop, flip.count};
        if (needs_ladder(opening.config))
            run.entry["truth_ladder"] = rung_entries(run.truth.pose(last), run.truth.frame(last)->masks);
    } else {
        if (!run.entry.contains("lit")) run.entry["lit"] = opening.config.has_reference ? "file" : "direct";
        run.entry["warnings"].push_back(
            opening.config.has_reference
                ? "This G-buffer came without a reference: its results are rendered and timed, not measured."
                : "The study asks for no reference: no error is measured.");
    }
    // No metric can tell, once techniques have read them.
    for (const FrameStep& step : run.shot.steps) run.store->frame(step, run.truth.lit(step));
    run.entry["gbuffer_non_finite"] = run.store->non_finite();
    for (const auto& [layer, count] : run.store->non_finite())
        opening.warn("The G-buffer holds " + std::to_string(count) + " values of '" + layer +
                     "' that are NaN or infinite: every result of this shot has read them.");
}

void open_scene(Opening& opening, const ShotConfig& config) {
    ShotRun& run = opening.run;
    run.shot = load_shot(config, opening.settings.search_path);
    opening.settings.say(run.shot.scene.name + ", camera " + run.shot.camera.name);
    run.source = scene_source(opening.device, run.shot, opening.config, opening.settings.keep_all);
    run.store = std::make_unique<FrameStore>(*run.source, run.shot.config.depth_format, max_stored_bytes);
    if (!opening.config.has_reference)
        run.truth = truth_of_lit(run.shot, [](unsigned) { return HostImage(); });
    else
        run.truth = shot_truth(run.shot, opening.config, *run.store, run.source->graph(),
                               [&](unsigned frame, ReferenceUse use) {
                                   Reference reference = obtain_reference(opening, frame, use);
                                   run.has_rendered_references |= !reference.from_cache;
                                   note_reference(opening, reference, frame, use);
                                   return reference;
                               });
}

/// A capture: measured if it comes with a reference, else only rendered and timed.
void open_capture(Opening& opening, const ShotConfig& config) {
    ShotRun& run = opening.run;
    run.capture = std::make_unique<Capture>(config.gbuffer);
    run.shot = capture_shot(config, *run.capture);
    opening.settings.say(run.shot.scene.name + ", from files");
    const CaptureContents contents = inspect_capture(run.shot, *run.capture);
    run.shot.facts = contents.facts;
    for (const std::string& note : contents.notes) {
        opening.settings.say("note: " + note);
        run.entry["warnings"].push_back(note);
    }
    const bool is_measured = !config.reference.empty();
    // A reference brings the path-traced lit colour; `ssrlab gbuffer` saves unshadowed direct light.
    const bool reads_own_lit = contents.has_lit && (!is_measured || config.direct_lit);
    if (reads_own_lit) run.entry["lit"] = "file";
    run.source = capture_source(opening.device, *run.capture, run.shot, reads_own_lit);
    run.store = std::make_unique<FrameStore>(*run.source, run.shot.config.depth_format, max_stored_bytes);
    if (is_measured)
        run.truth = shot_truth(run.shot, opening.config, *run.store, run.source->graph(),
                               [&](unsigned frame, ReferenceUse use) {
                                   Reference reference = read_capture_reference(
                                       run.shot, *run.capture, frame, use.is_of_last && needs_ladder(opening.config));
                                   note_reference(opening, reference, frame, use);
                                   return reference;
                               });
    else
        run.truth = truth_of_lit(run.shot, [&](unsigned frame) {
            return contents.has_lit ? channels_of(run.capture->load(frame).gbuffer.lit, 0, 3) : HostImage();
        });
}

}  // namespace

std::unique_ptr<ShotRun> open_shot(Device& device, const ShotConfig& shot, const Config& config,
                                   const ShotRunSettings& settings) {
    auto run = std::make_unique<ShotRun>();
    Opening opening{.device = device, .config = config, .settings = settings, .run = *run};
    run->entry["warnings"] = nlohmann::json::array();
    shot.gbuffer.empty() ? open_scene(opening, shot) : open_capture(opening, shot);
    enter_truth_images(opening);
    enter_shot(opening);
    return run;
}

Cell references_cell(const ShotRun& run) {
    return {.images = run.images, .truth = run.truth.content_hash(), .shot = run.entry};
}
