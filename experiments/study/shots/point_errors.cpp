#include "experiments/study/shots/point_errors.h"

#include "metrics/ghost.h"

#include <algorithm>
#include <cmath>

namespace {

/// Those that mean the same in every frame: a mask of one frame's confidence says nothing over several.
std::vector<Mask> masks_of_surfaces(const FrameTruth& truth) {
    std::vector<Mask> masks;
    for (const Mask& mask : truth.masks)
        if (!mask.inside.empty()) masks.push_back(mask);
    return masks;
}

}  // namespace

/// The full measure of the shot's last frame, and its part in the split over seeds.
void PointErrors::measure_last(const FrameTruth& truth, const CompositedImages& images, const ResultRow& row,
                               std::span<const Mask> masks) {
    std::vector<ResultRow> rows = measure_targets(*truth.pose, images, masks, row);
    set_lit_noise(rows, lit_noise_);
    keep_growth(rows, row.frame);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    const HostImage image = composited_image(*truth.pose, images);
    for (const auto& [target, reference] : truth.pose->targets) {
        const HostImage& tested = tested_image(target, images, image);
        if (tested.values.empty()) continue;
        splits_.try_emplace(target, reference).first->second.add(row.seed, tested);
        add_swapped_errors(noise_, row.frame, target, reference, tested, masks);
    }
}

/// Moves it from the rows to what effects are made of.
void PointErrors::keep_growth(std::vector<ResultRow>& rows, const std::string& frame) {
    for (ResultRow& r : rows) add_growth(noise_, {r.target, r.metric, r.mask, frame}, std::exchange(r.growth, {}));
}

/// Whether the full measure of the last frame holds this row already.
bool PointErrors::is_in_full_measure(const ResultRow& row) const {
    return row.frame == std::to_string(point_.last_step().frame) &&
           std::ranges::count(point_.config.targets, "specular") > 0 &&
           std::ranges::count(point_.config.metrics, row.metric) > 0;
}

/// A frame of several.
void PointErrors::measure_in_passing(SeedErrors& seed, const PoseTruth& truth, const HostImage& specular,
                                     std::span<const Mask> masks, const ResultRow& row) {
    FrameRows frame = measure_frame(truth, specular, masks, row);
    set_lit_noise(frame.rows, lit_noise_);
    const bool makes_means = !point_.shot.config.measures_last_only;
    if (makes_means) seed.means.add(frame), keep_growth(frame.rows, over_frames);
    seed.frame_rows.insert(seed.frame_rows.end(), frame.rows.begin(), frame.rows.end());
    if (!makes_means) return;
    add_swapped_errors(noise_, over_frames, "specular", *truth.frame_reference, specular, masks);
}

/// Frames before the first measured one are what the eye saw earlier, as far back as their truth is known.
void PointErrors::add_to_video(SeedErrors& seed, const FrameStep& step, const HostImage& specular) const {
    const Shot& shot = point_.shot;
    const auto pose = point_.truth.poses.find(step.frame);
    if (pose == point_.truth.poses.end() || !pose->second->frame_reference) {
        seed.video.reset();
        return;
    }
    const HostImage& direct = pose->second->direct;
    const MetricReference& reference = *pose->second->frame_reference;
    if (!seed.video) seed.video.emplace(direct.extent, reference.settings, shot.scene.frame_rate);
    const auto image = [&](const HostImage& reflections) { return sum(direct, reflections); };
    seed.video->add(image(specular),
                    {image(reference.image), image(reference.halves ? reference.halves->a : reference.image),
                     image(reference.halves ? reference.halves->b : reference.image)},
                    !step.is_warm_up && step.frame >= shot.config.measure_from);
}

void PointErrors::add(SeedErrors& seed, const FrameStep& step, const CompositedImages& images) {
    const HostImage before = std::exchange(seed.before, images.specular);
    if (step.is_held) seed.held.add(images.specular);
    if (measures_video(point_.shot.config, point_.config)) add_to_video(seed, step, images.specular);
    if (is_after_change(point_.shot, step)) seed.after_change.push_back(images.specular);
    const FrameTruth* truth = point_.truth.frame(step);
    if (!truth) return;
    const std::vector<Mask> masks = masks_of(*truth, images.confidence, point_.config);
    if (measures_difference(point_.shot, step)) {
        const MetricReference &reference_before = *point_.truth.poses.at(*step.previous_frame)->frame_reference,
                              &reference = *truth->pose->frame_reference;
        seed.difference.add(before, images.specular, reference_before, reference, masks);
        seed.ghosts.add(images.specular, reference_before, reference, masks);
    }
    if (!step.is_measured) return;
    const ResultRow row = point_.row(std::to_string(step.frame), seed.seed);
    if (truth->pose->frame_reference && point_.shot.config.frames.size() > 1)
        measure_in_passing(seed, *truth->pose, images.specular, masks, row);
    if (point_.is_last(step)) measure_last(*truth, images, row, masks);
}

/// Rows of temporal metrics, which are over several frames.
void PointErrors::add_temporal_rows(unsigned seed, const std::vector<TemporalScore>& scores,
                                    const std::string& target) {
    for (const TemporalScore& s : scores) {
        if (s.pixels + s.left_out == 0) continue;  // nothing of this scene lies under the mask
        ResultRow r = point_.row(over_frames, seed);
        r.target = target, r.metric = s.metric->name, r.formula = s.formula, r.mask = s.mask;
        const auto if_finite = [](std::optional<double> v) { return v && std::isfinite(*v) ? v : std::nullopt; };
        r.value = if_finite(s.value), r.uncorrected = s.uncorrected ? if_finite(s.uncorrected) : r.value,
        r.corrected = s.corrected;
        r.low = if_finite(s.low), r.high = if_finite(s.high), r.pixels = s.pixels, r.non_finite = s.left_out;
        rows_.push_back(std::move(r));
        if (!s.note.empty()) missing_[{s.metric->name, s.note}].insert(s.mask);
    }
}

/// What the reference's noise does to each seed's metrics of its steps.
void PointErrors::keep_noise(const SeedErrors& seed) {
    const auto keep = [&](const std::string& metric, const std::string& mask, const NoisyMap& noise, double scale) {
        std::vector<double> parts = group_sums(noise.swapped, full_mask(noise.swapped.extent));
        for (double& part : parts) part *= double(noise.swapped.values.size()) / scale;
        noise_[{"specular", metric, mask, over_frames}].add(parts);
    };
    for (const FrameDifference::Sums& s : seed.difference.sums) {
        if (!seed.difference.has_halves || s.pixels == 0) continue;
        keep("frame_difference", s.mask, s.noise[0], double(s.pixels));
        keep("frame_difference_relative", s.mask, s.noise[1], double(s.pixels));
    }
    for (const GhostShare::Sums& s : seed.ghosts.sums)
        if (seed.ghosts.has_halves && s.change > 0) keep("ghost_share", s.mask, s.noise(), s.change);
    if (seed.video && !seed.video->noise().empty())
        noise_[{"image", video_jod_name, "all", over_frames}].add(seed.video->noise());
}

void PointErrors::add_whole(SeedErrors& seed) {
    for (const ResultRow& r : seed.frame_rows)
        if (std::ranges::count(point_.config.frame_masks, r.mask) > 0 && !is_in_full_measure(r)) rows_.push_back(r);
    const std::vector<ResultRow> means = seed.means.rows();
    rows_.insert(rows_.end(), means.begin(), means.end());

    const FrameTruth* last = point_.truth.frame(point_.last_step());
    if (!last) return;
    const Shot& shot = point_.shot;
    const std::vector<Mask> masks = masks_of_surfaces(*last);
    if (shot.config.frames.size() == 1 && seed.held.frames.count >= 2)
        add_temporal_rows(seed.seed, flicker_scores(seed.held, &*last->pose->frame_reference, masks));
    if (!seed.difference.sums.empty()) {
        add_temporal_rows(seed.seed, seed.difference.scores());
        add_temporal_rows(seed.seed, seed.ghosts.scores());
    }
    if (seed.video) add_temporal_rows(seed.seed, {seed.video->score()}, "image");
    keep_noise(seed);
    if (!shot.config.change) return;
    const PoseTruth& before =
        *point_.truth.poses.at(*std::ranges::find(shot.steps, *shot.config.change, &FrameStep::frame)->previous_frame);
    for (const Ghost& ghost :
         ghost_scores(seed.after_change, *before.frame_reference, *last->pose->frame_reference, masks))
        add_temporal_rows(seed.seed, {ghost.ghost_length, ghost.settling_length});
}

std::vector<SplitRow> PointErrors::rows_of_splits() const {
    std::vector<SplitRow> rows;
    const FrameTruth* last = point_.truth.frame(point_.last_step());
    if (!last) return rows;
    const std::vector<Mask> masks = masks_of_surfaces(*last);
    for (const auto& [target, split] : splits_) {
        const SplitRow shared{.shot = point_.shot.name(),
                              .frame = std::to_string(point_.last_step().frame),
                              .technique = point_.technique.technique,
                              .point = point_.technique.point,
                              .target = target,
                              .mask = {}};
        for (SplitRow& row : split_rows(split, masks, shared, point_.technique.depends_on_seed, lit_noise_))
            rows.push_back(std::move(row));
    }
    return rows;
}

/// Why some temporal metrics have no value.
std::vector<std::string> PointErrors::notes() const {
    std::vector<std::string> notes;
    for (const auto& [what, masks] : missing_) {
        std::string note = point_.shot.name() + ": " + point_.technique.technique + " " + point_.technique.point +
                           ": no " + what.first + ": " + what.second + " (";
        for (const std::string& mask : masks) note += (note.back() == '(' ? "" : ", ") + mask;
        notes.push_back(note + ")");
    }
    return notes;
}

void PointErrors::move_to(Cell& cell) {
    cell.results = std::move(rows_);
    cell.splits = rows_of_splits();
    cell.reference_noise = means_of(
        noise_, {.shot = point_.shot.name(), .technique = point_.technique.technique, .point = point_.technique.point});
    cell.notes = notes();
}
