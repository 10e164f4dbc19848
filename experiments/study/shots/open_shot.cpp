#include "experiments/study/shots/open_shot.h"

#include "core/files.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "core/number_text.h"
#include "experiments/study/measuring/noise_places.h"
#include "experiments/study/measuring/reflection_probe.h"
#include "experiments/study/measuring/rung_errors.h"
#include "experiments/study/shots/result_images.h"
#include "experiments/study/shots/shot_facts.h"
#include "groundtruth/reference/reference_cache.h"
#include "metrics/noise.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <span>

namespace {

/// Device memory for G-buffers that are kept: 32 frames of 480x270 take half of it.
constexpr size_t max_stored_bytes = size_t(1) << 30;

/// A shot while it is opened.
struct Opening {
    Device& device;
    const Config& config;
    const OpenShotSettings& settings;
    OpenShot& shot;
    std::map<unsigned, std::vector<nlohmann::json>> reference_images = {};  ///< by the frame whose reference they are

    void warn(const std::string& text) {
        shot.entry["warnings"].push_back(text);
        settings.say("warning: " + shot.shot.name() + ": " + text);
    }
};

ReferenceRun run_of(const Opening& opening, const std::string& what) {
    ReferenceRun run;
    run.progress = [&opening, what](double fraction, double rays_per_second, double) {
        opening.settings.report(fraction,
                                opening.shot.shot.name() + ": " + what + ", " + ray_rate_text(rays_per_second));
    };
    run.notice = [&opening](const std::string& text) { opening.settings.say("note: " + text); };
    return run;
}

/// Renders the reference of one frame, or takes it from the cache. Targets are of the last frame, so that only its
/// reference needs a truth ladder.
Reference obtain_reference(const Opening& opening, unsigned frame, ReferenceUse use) {
    const Shot& shot = opening.shot.shot;
    const ShotFrame now = shot_frame(shot, frame);
    return cached_reference(shot.scene, now.scene, now.camera, shot.config.extent,
                            settings_of(opening.config, use, opening.settings.keep_all), opening.settings.cache,
                            run_of(opening, "reference of frame " + std::to_string(frame)));
}

/// What reflections fall back to, of a shot that asks for a probe.
std::optional<Environment> obtain_probe(const Opening& opening) {
    const Shot& shot = opening.shot.shot;
    if (!shot.config.has_probe) return {};
    const ShotFrame first = shot_frame(shot, shot.config.frames.front());
    ReferenceSettings settings = opening.config.reference;
    settings.keep_all = opening.settings.keep_all;
    return reflection_probe(first.camera.world_from_view[3], settings,
                            [&](const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& of_face) {
                                return cached_reference(shot.scene, first.scene, camera, extent, of_face,
                                                        opening.settings.cache, run_of(opening, "reflection probe"));
                            });
}

/// Keeps for the manifest what is worth knowing of a reference, and writes its images if they are kept.
void note_reference(Opening& opening, const Reference& reference, unsigned frame, ReferenceUse use) {
    OpenShot& open = opening.shot;
    nlohmann::json entry = reference_entry(reference, frame, opening.config);
    for (const nlohmann::json& warning : entry["warnings"])
        opening.settings.say("warning: " + open.shot.name() + ", frame " + std::to_string(frame) + ": " +
                             warning.get<std::string>());
    open.entry["references"].push_back(std::move(entry));
    if (use.is_of_last) open.entry["reference"] = open.entry["references"].back();
    if (opening.config.kept_images == KeptImages::none) return;
    const std::filesystem::path& out = opening.settings.out;
    const float exposure_ev = open.shot.camera.exposure_ev;
    if (use.is_of_last || (opening.config.kept_images == KeptImages::measured && use.is_of_measured))
        opening.reference_images[frame] = save_reference_images(out, open.shot.name(), frame, reference, exposure_ev);
    else if (opening.config.kept_images == KeptImages::played)
        opening.reference_images[frame] = {save_played_reference(
            out, open.shot.name(), frame,
            reference.is_lit_only() ? obtain_reference(opening, frame, {.is_compared = true}) : reference,
            exposure_ev)};
}

/// Lists the images of the references, and writes those of the surfaces, of each frame whose results are kept. Frames
/// that look alike share the files.
void enter_truth_images(Opening& opening) {
    OpenShot& open = opening.shot;
    for (const FrameStep& step : open.shot.steps) {
        const StepImages kept = open.shot.images_of(step, opening.config.kept_images);
        const auto pose = open.truth.poses.find(step.frame);
        if (kept == StepImages::none || pose == open.truth.poses.end()) continue;
        for (const auto& [frame, images] : opening.reference_images) {
            if (open.truth.poses.at(frame) != pose->second) continue;
            for (nlohmann::json image : images) {
                image["frame"] = step.frame;
                open.images.push_back(std::move(image));
            }
        }
        if (const FrameTruth* truth = open.truth.frame(step); truth && kept == StepImages::all)
            open.images.push_back(
                save_roughness_image(opening.settings.out, open.shot.name(), step.frame, truth->roughness));
    }
}

/// Which pixels hold the noise of the last frame's reference, under the mask and of the target that the study compares.
void enter_noise(Opening& opening, const FrameStep& last) {
    OpenShot& open = opening.shot;
    const FrameTruth* truth = open.truth.frame(last);
    const std::string &mask = opening.config.primary.mask, &target = opening.config.primary.target;
    const auto compared = open.truth.pose(last).targets.find(target);
    if (!truth || compared == open.truth.pose(last).targets.end() || !compared->second.halves) return;
    const auto inside = std::ranges::find(truth->masks, mask, &Mask::name);
    if (inside == truth->masks.end() || inside->inside.empty()) return;  // one of a technique's confidence
    const NoisePlaces places = noise_places(compared->second.halves->variance, truth->roughness, *inside);
    open.entry["reference"]["noise"] = noise_entry(places, target, mask);
    const double samples = compared->second.halves->samples;
    if (double(places.pixels) * samples < least_noise_samples)
        opening.settings.say("warning: " + open.shot.name() + ": the mask " + mask + " holds " +
                             std::to_string(places.pixels) + (places.pixels == 1 ? " pixel" : " pixels") +
                             ", whose samples are too few for an interval. Render a larger image, or give "
                             "reference.samples a larger number.");
}

/// What the manifest says of the shot that its G-buffers and its truth tell.
void enter_shot(Opening& opening) {
    OpenShot& open = opening.shot;
    const FrameStep& last = open.shot.steps.back();
    const FrameStore::Frame frame = open.store->frame(last, open.truth.lit(last));
    const HostGBuffer host =
        download_gbuffer(open.source->pass_list(), frame.gbuffer, frame.camera, open.shot.config.depth_format);
    open.entry["needs"] = fact_entries(list_facts(pixel_facts(host)));
    if (open.truth.is_measured()) {
        const FlipExposures& flip = open.truth.pose(last).flip_exposures;
        open.entry["flip_exposures"] = {flip.start, flip.stop, flip.count};
        enter_noise(opening, last);
        if (needs_ladder(opening.config))
            open.entry["truth_ladder"] = rung_entries(open.truth.pose(last), open.truth.frame(last)->masks);
    } else {
        if (!open.entry.contains("lit")) open.entry["lit"] = opening.config.has_reference ? "file" : "direct";
        open.entry["warnings"].push_back(
            opening.config.has_reference
                ? "This G-buffer came without a reference: its results are rendered and timed, not measured."
                : "The study asks for no reference: no error is measured.");
    }
    // No metric can tell, once techniques have read them.
    for (const FrameStep& step : open.shot.steps) open.store->frame(step, open.truth.lit(step));
    open.entry["gbuffer_non_finite"] = open.store->non_finite();
    for (const auto& [layer, count] : open.store->non_finite())
        opening.warn("The G-buffer holds " + std::to_string(count) + " values of '" + layer +
                     "' that are NaN or infinite: every result of this shot has read them.");
}

void open_scene(Opening& opening, const ShotConfig& config) {
    OpenShot& open = opening.shot;
    open.shot = load_shot(config, opening.settings.search_path);
    open.probe = obtain_probe(opening);
    open.source = scene_source(opening.device, open.shot, opening.config, opening.settings.keep_all,
                               open.probe ? &*open.probe : nullptr);
    open.store = std::make_unique<FrameStore>(*open.source, open.shot.config, max_stored_bytes);
    if (!opening.config.has_reference)
        open.truth = truth_of_lit(open.shot, [](unsigned) { return HostImage(); });
    else
        open.truth = shot_truth(open.shot, opening.config, *open.store, open.source->pass_list(),
                                [&](unsigned frame, ReferenceUse use) {
                                    Reference reference = obtain_reference(opening, frame, use);
                                    open.has_rendered_references |= !reference.from_cache;
                                    note_reference(opening, reference, frame, use);
                                    return reference;
                                });
    if (open.probe) {
        ContentHash hash;
        hash.add(std::as_bytes(std::span(open.probe->latlong.values)));
        open.truth.probe_hash = hash.hex();
    }
}

/// A capture: measured if it comes with a reference, else only rendered and timed.
void open_capture(Opening& opening, const ShotConfig& config) {
    OpenShot& open = opening.shot;
    open.capture = std::make_unique<Capture>(config.gbuffer);
    open.shot = capture_shot(config, *open.capture);
    const CaptureContents contents = inspect_capture(open.shot, *open.capture);
    open.shot.facts = contents.facts;
    for (const std::string& note : contents.notes) {
        opening.settings.say("note: " + note);
        open.entry["warnings"].push_back(note);
    }
    const bool is_measured = !config.reference.empty();
    // A reference brings the path-traced lit colour; `ssrlab gbuffer` saves unshadowed direct light.
    const bool reads_own_lit = contents.has_lit && (!is_measured || config.direct_lit);
    if (reads_own_lit) open.entry["lit"] = "file";
    open.source = capture_source(opening.device, *open.capture, open.shot, reads_own_lit);
    open.store = std::make_unique<FrameStore>(*open.source, open.shot.config, max_stored_bytes);
    if (is_measured)
        open.truth = shot_truth(
            open.shot, opening.config, *open.store, open.source->pass_list(), [&](unsigned frame, ReferenceUse use) {
                Reference reference = read_capture_reference(open.shot, *open.capture, frame,
                                                             use.is_of_last && needs_ladder(opening.config));
                note_reference(opening, reference, frame, use);
                return reference;
            });
    else
        open.truth = truth_of_lit(open.shot, [&](unsigned frame) {
            return contents.has_lit ? channels_of(open.capture->load(frame).gbuffer.lit, 0, 3) : HostImage();
        });
}

}  // namespace

std::unique_ptr<OpenShot> open_shot(Device& device, const ShotConfig& shot, const Config& config,
                                    const OpenShotSettings& settings) {
    auto open = std::make_unique<OpenShot>();
    Opening opening{.device = device, .config = config, .settings = settings, .shot = *open};
    open->entry["warnings"] = nlohmann::json::array();
    shot.gbuffer.empty() ? open_scene(opening, shot) : open_capture(opening, shot);
    enter_truth_images(opening);
    enter_shot(opening);
    return open;
}

Cell references_cell(const OpenShot& open) {
    return {
        .images = open.images, .truth = open.truth.content_hash(), .shot = open.entry, .seconds = open.opening_seconds};
}
