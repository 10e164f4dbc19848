#include "experiments/study/measuring/shot_truth.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "experiments/study/measuring/frames/lit_filter.h"

#include <algorithm>
#include <utility>

namespace {

bool is_capture(const Shot& shot) { return !shot.config.gbuffer.empty(); }

/// Whether anything of the frame is compared with the truth, or lit by it.
bool needs_reference(const Shot& shot, const FrameStep& step) {
    if (!shot.config.direct_lit) return true;
    return step.is_measured || step.is_held || measures_difference(shot, step) || is_after_change(shot, step);
}

/// Equal for poses that look alike.
std::string look_of(const Shot& shot, unsigned frame, const ReferenceSettings& settings) {
    if (is_capture(shot)) return capture_reference_file(shot.config, frame).string();
    const ShotFrame now = shot_frame(shot, frame);
    return reference_stream(shot.scene, now.scene, now.camera, shot.config.extent, settings);
}

void check_change(const Shot& shot, const std::map<unsigned, std::string>& looks) {
    if (!shot.config.change) return;
    for (const FrameStep& step : shot.steps)
        if (is_after_change(shot, step) && looks.at(step.frame) != looks.at(*shot.config.change))
            fail("shot ", shot.name(), ": 'change' = ", *shot.config.change, ", but frame ", step.frame,
                 " looks different from it; ghosting can only be measured where nothing moves after the change");
}

/// Replaces what techniques read.
void filter(PoseTruth& pose, const ReferenceOutput& lit, const Shot& shot, unsigned frame) {
    const ShotFrame now = shot_frame(shot, frame);
    FilteredLit filtered = filter_lit(lit, lit_surfaces(shot.scene, now.scene, now.camera, shot.config.extent));
    pose.diffuse = std::move(filtered.mean);
    pose.lit_halves = {.a = std::move(filtered.half_a), .b = std::move(filtered.half_b)};
}

}  // namespace

bool measures_difference(const Shot& shot, const FrameStep& step) {
    return !shot.config.measures_last_only && !step.is_warm_up && step.frame != step.previous_frame &&
           step.frame > std::max(shot.config.frames.front(), shot.config.measure_from);
}

bool measures_video(const ShotConfig& shot, const Config& config) {
    const auto names_it = [](const std::vector<std::string>& metrics) {
        return std::ranges::count(metrics, std::string("cvvdp_0_5_6")) > 0;
    };
    const bool has_several = shot.repeat > 1 || (shot.frames.size() > 1 && !shot.measures_last_only);
    return has_several && (names_it(config.metrics) || names_it(config.frame_metrics));
}

bool is_after_change(const Shot& shot, const FrameStep& step) {
    return shot.config.change && step.frame >= *shot.config.change;
}

std::set<unsigned> compared_frames(const Shot& shot) {
    std::set<unsigned> compared;
    for (const FrameStep& step : shot.steps) {
        const bool is_in_sequence = measures_difference(shot, step) || is_after_change(shot, step);
        if (step.is_measured || step.is_held || is_in_sequence) compared.insert(step.frame);
        if (is_in_sequence && step.previous_frame) compared.insert(*step.previous_frame);
    }
    return compared;
}

const FrameTruth* ShotTruth::frame(const FrameStep& step) const {
    const auto found = frames.find({step.frame, step.previous_frame});
    return found == frames.end() ? nullptr : &found->second;
}

const HostImage& ShotTruth::lit(const FrameStep& step) const {
    static const HostImage none;
    const auto found = poses.find(step.frame);
    return found == poses.end() ? none : found->second->diffuse;
}

std::string ShotTruth::content_hash() const {
    ContentHash hash;
    for (const auto& [frame, pose] : poses) hash.add(frame), hash.add(pose->content_hash);
    if (!probe_hash.empty()) hash.add(probe_hash);
    return hash.hex();
}

ReferenceSettings settings_of(const Config& config, ReferenceUse use, bool keep_all) {
    ReferenceSettings settings = config.reference;
    settings.keep_all = keep_all;
    settings.ladder = use.is_of_last && needs_ladder(config);
    if (use.is_compared) return settings;
    settings.lit_only = true;
    settings.adaptive_share = 0;
    const bool has_target = std::exchange(settings.target_relative_error, 0.0f) > 0;
    if (const unsigned lit = std::exchange(settings.lit_samples, 0u); lit > 0)
        settings.max_samples = lit;
    else if (has_target && (settings.max_samples == 0 || settings.max_samples > ReferenceSettings::default_samples))
        settings.max_samples = ReferenceSettings::default_samples;
    return settings;
}

ShotTruth shot_truth(const Shot& shot, const Config& config, FrameStore& store, PassList& pass_list,
                     const std::function<Reference(unsigned frame, ReferenceUse use)>& obtain) {
    std::map<unsigned, std::string> looks;
    for (const FrameStep& step : shot.steps)
        if (!looks.contains(step.frame)) looks[step.frame] = look_of(shot, step.frame, config.reference);
    check_change(shot, looks);

    ShotTruth truth;
    std::set<std::string> compared;
    for (const unsigned frame : compared_frames(shot)) compared.insert(looks.at(frame));
    std::map<std::string, std::shared_ptr<const PoseTruth>> by_look;
    const bool has_several = shot.steps.size() > shot.config.warm_up + 1;
    for (const FrameStep& step : shot.steps) {
        if (truth.poses.contains(step.frame) || !needs_reference(shot, step)) continue;
        std::shared_ptr<const PoseTruth>& pose = by_look[looks[step.frame]];
        const std::string& look = looks[step.frame];
        const ReferenceUse use{
            .is_of_last = look == looks[shot.config.frames.back()],
            .is_of_measured = std::ranges::any_of(
                shot.steps, [&](const FrameStep& s) { return s.is_measured && looks[s.frame] == look; }),
            .is_compared = compared.contains(look)};
        if (!pose) {
            const Reference reference = obtain(step.frame, use);
            PoseTruth made =
                pose_truth(reference, config, shot.camera.exposure_ev,
                           {.has_targets = use.is_of_last, .has_frame_reference = has_several && use.is_compared});
            if (config.filters_lit && !is_capture(shot) && !shot.config.direct_lit)
                filter(made, reference.diffuse, shot, step.frame);
            pose = std::make_shared<PoseTruth>(std::move(made));
        }
        truth.poses[step.frame] = pose;
    }
    for (const FrameStep& step : shot.steps) {
        if (!step.is_measured && !measures_difference(shot, step)) continue;
        const FrameStore::Frame frame = store.frame(step, truth.lit(step));
        const HostGBuffer gbuffer = download_gbuffer(pass_list, frame.gbuffer, frame.camera, shot.config.depth_format);
        truth.frames.emplace(std::pair(step.frame, step.previous_frame),
                             frame_truth(truth.poses.at(step.frame), gbuffer, config));
    }
    return truth;
}

ShotTruth truth_of_lit(const Shot& shot, const std::function<HostImage(unsigned frame)>& lit) {
    ShotTruth truth;
    for (const unsigned frame : shot.config.frames) {
        const HostImage of_frame = lit(frame);
        truth.poses[frame] = std::make_shared<PoseTruth>(PoseTruth{.diffuse = of_frame,
                                                                   .lit_halves = {},
                                                                   .direct = of_frame,
                                                                   .targets = {},
                                                                   .rungs = {},
                                                                   .view_depth = {},
                                                                   .normal = {},
                                                                   .material_id = {},
                                                                   .flip_exposures = {},
                                                                   .content_hash = "none"});
    }
    return truth;
}
