#include "experiments/play.h"

#include "core/gbuffer/composite.h"
#include "core/gpu/device.h"
#include "experiments/exact_rays.h"
#include "experiments/frame_means.h"
#include "experiments/judged_hits.h"
#include "experiments/lit_noise.h"
#include "experiments/manifest.h"
#include "experiments/render_variant.h"
#include "experiments/splits.h"
#include "metrics/flicker.h"
#include "metrics/frame_difference.h"
#include "metrics/ghost.h"
#include "variants/registry.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

/// One seed on its way through the shot.
struct SeedRun {
    unsigned seed;
    std::unique_ptr<Variant> variant;
    std::unique_ptr<RayProbe> probe;  ///< of the variant
    std::unique_ptr<PassGraph> graph;
    std::unique_ptr<Compositor> compositor;

    std::vector<ResultRow> frame_rows;
    FrameMeans means;
    FlickerMoments held;
    FrameDifference difference;
    std::vector<HostImage> after_change;
    HostImage before;  ///< `specular` of the frame before
};

/// What all functions below need to know.
struct Play {
    Device& device;
    const Shot& shot;
    const ShotTruth& truth;
    FrameStore& store;
    const Config& config;
    const VariantConfig& variant;
    const PlaySettings& settings;
    Cell cell;
    std::map<std::string, SeedSplit> splits;  ///< by target, of the last frame
    ReferenceNoiseMeans noise = {};
    LitNoises lit_noise = {};
    std::map<std::pair<std::string, std::string>, std::set<std::string>>
        untold;  ///< masks, by temporal metric and reason
    size_t rendered = 0;
    std::map<unsigned, ExactRays> exact_rays = {};  ///< by frame
    std::map<unsigned, JudgedHits> judged = {};     ///< by frame

    const FrameStep& last_step() const { return shot.steps.back(); }
    ResultRow row(const std::string& frame, unsigned seed) const {
        return {.shot = shot.name(),
                .scene = shot.scene.name,
                .camera = shot.camera.name,
                .frame = frame,
                .width = shot.config.extent.x,
                .height = shot.config.extent.y,
                .variant = variant.variant,
                .point = variant.point,
                .seed = seed};
    }
};

SeedRun start(Play& play, unsigned seed) {
    const VariantConfig& v = play.variant;
    SeedRun run{.seed = seed,
                .variant = make_variant(v.variant, v.parameters, v.preset),
                .probe = std::make_unique<RayProbe>(),
                .graph = std::make_unique<PassGraph>(play.device, play.shot.config.extent)};
    run.variant->ray_probe = run.probe.get();
    if (!play.settings.keep_all) run.variant->leave_out(play.shot.facts);
    run.compositor = std::make_unique<Compositor>(*run.graph);
    return run;
}

/// Whether the lit colour that variants read is that of the reference.
bool reads_reference_light(const Play& play) {
    return !play.config.direct_lit && play.truth.is_measured() &&
           std::ranges::all_of(play.truth.poses, [](const auto& pose) { return pose.second->lit_halves.has_value(); });
}

bool reads_noisy_light(const Play& play) {
    return reads_reference_light(play) &&
           std::ranges::any_of(play.truth.poses, [](const auto& pose) { return is_noisy(*pose.second->lit_halves); });
}

/// How many seeds' images are held at once: those of a technique take some 400 bytes per pixel, and what means over
/// frames need 150 more, so this is about 1.6 GB.
size_t seeds_at_once(glm::uvec2 extent) {
    constexpr size_t pixels = 3'000'000;
    return std::max<size_t>(1, pixels / (size_t(extent.x) * extent.y));
}

/// The full measure of the shot's last frame, its images, and its part in the split over seeds.
void measure_last(Play& play, const FrameTruth& truth, const CompositedImages& images, const ResultRow& row,
                  std::span<const Mask> masks) {
    std::vector<ResultRow> rows = measure_targets(*truth.pose, images, masks, row);
    play.lit_noise.set(rows);
    play.cell.rows.insert(play.cell.rows.end(), rows.begin(), rows.end());
    const HostImage image = composited_image(*truth.pose, images);
    for (const auto& [target, reference] : truth.pose->targets) {
        const HostImage& tested = tested_image(target, images, image);
        play.splits.try_emplace(target, reference).first->second.add(row.seed, tested);
        play.noise.add(row.frame, target, reference, tested, masks);
    }
}

/// Whether the full measure of the last frame holds this row already.
bool is_in_full_measure(const Play& play, const ResultRow& row) {
    return row.frame == std::to_string(play.last_step().frame) &&
           std::ranges::count(play.config.targets, "specular") > 0 &&
           std::ranges::count(play.config.metrics, row.metric) > 0;
}

/// A frame of several.
void measure_in_passing(Play& play, SeedRun& run, const PoseTruth& truth, const HostImage& specular,
                        std::span<const Mask> masks, const ResultRow& row) {
    FrameRows frame = measure_frame(truth, specular, masks, row);
    play.lit_noise.set(frame.rows);
    run.frame_rows.insert(run.frame_rows.end(), frame.rows.begin(), frame.rows.end());
    if (play.shot.config.measures_last_only) return;
    run.means.add(frame);
    play.noise.add("all", "specular", *truth.frame_reference, specular, masks);
}

/// What one rendered frame adds to the results of its seed.
void measure_step(Play& play, SeedRun& run, const FrameStep& step, const CompositedImages& images) {
    if (step.is_held) run.held.add(images.specular);
    if (is_after_change(play.shot, step)) run.after_change.push_back(images.specular);
    const FrameTruth* truth = play.truth.frame(step);
    if (!truth) return;
    const std::vector<Mask> masks = masks_of(*truth, images.confidence, play.config);
    if (measures_difference(play.shot, step))
        run.difference.add(run.before, images.specular, *play.truth.poses.at(*step.previous_frame)->frame_reference,
                           *truth->pose->frame_reference, masks);
    if (!step.is_measured) return;
    const ResultRow row = play.row(std::to_string(step.frame), run.seed);
    if (truth->pose->frame_reference && play.shot.config.frames.size() > 1)
        measure_in_passing(play, run, *truth->pose, images.specular, masks, row);
    if (&step == &play.last_step()) measure_last(play, *truth, images, row, masks);
}

void report_step(Play& play) {
    const size_t runs = play.variant.seeds.size() + (reads_noisy_light(play) ? 2 : 0);
    play.settings.report(double(++play.rendered) / double(play.shot.steps.size() * runs));
}

const ExactRays& exact_rays(Play& play, const FrameStep& step, const CameraData& camera) {
    return play.exact_rays.try_emplace(step.frame, play.shot, step.frame, camera).first->second;
}

/// What the step's rays truly meet, for the tracer exact_scene; a capture has no scene to ask.
void plug_in_scene(Play& play, SeedRun& run, const FrameStep& step, const FrameStore::Frame& frame) {
    if (!play.shot.config.gbuffer.empty()) return;
    run.probe->exact_hits = [&play, &step, camera = frame.camera](const RecordedRays& recorded) {
        return exact_rays(play, step, camera).hits(recorded);
    };
}

const Mask everywhere{.name = "all", .extent = {}, .inside = {}};  // the only one that needs no truth

bool judges_rays(const Play& play, const SeedRun& run, const FrameStep& step) {
    const auto& seeds = play.variant.seeds;
    if (!play.variant.depends_on_seed && run.seed != seeds.front()) return false;  // it would trace the same rays
    return play.config.hits && step.is_measured && play.shot.config.gbuffer.empty() &&
           size_t(std::ranges::find(seeds, run.seed) - seeds.begin()) < play.config.hits->seeds;
}

/// The rays that were recorded in this step against what they truly meet.
void judge_rays(Play& play, SeedRun& run, const FrameStep& step, const CameraData& camera,
                std::span<const Mask> masks) {
    const ResultRow row = play.row(std::to_string(step.frame), run.seed);
    const bool is_shown = &step == &play.last_step() && run.seed == play.variant.seeds.front();
    for (const RecordedRays& recorded : run.probe->recorded) {
        const std::vector<ExactHit> truth = exact_rays(play, step, camera).hits(recorded, play.config.hits->every);
        play.judged[step.frame].add(run.seed, recorded, truth, play.shot.config.extent, play.config.hits->every,
                                    {masks.begin(), masks.end()});
        if (is_shown && play.config.hits->every == 1)
            play.cell.images.push_back(save_verdict_image(play.settings.out, row, play.settings.image_suffix,
                                                          recorded.stage,
                                                          map_of_verdicts(recorded, truth, play.shot.config.extent)));
    }
    run.probe->recorded.clear();
}

void add_hits(Play& play) {
    for (const auto& [frame, judged] : play.judged) {
        const HitRow shared{.shot = play.shot.name(),
                            .frame = std::to_string(frame),
                            .variant = play.variant.variant,
                            .point = play.variant.point,
                            .stage = {},
                            .mask = {},
                            .quantity = {},
                            .low = {},
                            .high = {}};
        for (HitRow& row : judged.rows(shared)) play.cell.hits.push_back(std::move(row));
    }
}

void render_step(Play& play, SeedRun& run, const FrameStep& step, const FrameStore::Frame& frame) {
    plug_in_scene(play, run, step, frame);
    run.probe->is_recording = judges_rays(play, run, step);
    const Reflections reflections = render_variant(*run.graph, *run.variant, frame.camera, run.seed, frame.gbuffer);
    if (!step.is_warm_up) {
        const Composite composite = run.compositor->render(frame.gbuffer, reflections);
        const FrameTruth* truth = play.truth.frame(step);
        const CompositedImages images = download_results(*run.graph, frame.gbuffer, reflections, composite,
                                                         truth ? truth->reflectance : HostImage{});
        measure_step(play, run, step, images);
        if (run.probe->is_recording)
            judge_rays(play, run, step, frame.camera,
                       truth ? masks_of(*truth, images.confidence, play.config) : std::vector<Mask>{everywhere});
        const bool is_kept = &step == &play.last_step() && run.seed == play.variant.seeds.front();
        if (is_kept && play.config.has_reference)
            for (nlohmann::json& entry : save_result_images(
                     play.settings.out, play.row(std::to_string(step.frame), run.seed), play.settings.image_suffix,
                     play.truth.pose(step), images, play.shot.camera.exposure_ev))
                play.cell.images.push_back(std::move(entry));
        run.before = images.specular;
    }
    report_step(play);
}

/// The result of a step for which the variant reads `lit` (RGB).
CompositedImages rendered_with(Play& play, SeedRun& run, const FrameStep& step, FrameStore::Frame frame,
                               const HostImage& lit) {
    HostImage rgba(lit.extent, 4);
    for (size_t i = 0; i < lit.pixel_count(); ++i) rgba.set_rgb(i, lit.rgb(i));
    plug_in_scene(play, run, step, frame);
    frame.gbuffer.lit = run.graph->image("lit_of_half", Format::rgba32f).as("lit");
    run.graph->upload(frame.gbuffer.lit, rgba);
    const Reflections reflections = render_variant(*run.graph, *run.variant, frame.camera, run.seed, frame.gbuffer);
    report_step(play);
    const FrameTruth* truth = play.truth.frame(step);
    if (!step.is_measured || !truth) return {};
    const Composite composite = run.compositor->render(frame.gbuffer, reflections);
    return download_results(*run.graph, frame.gbuffer, reflections, composite, truth->reflectance);
}

/// Plays the shot with the light of each half of the reference, to tell what the noise of the light adds.
void measure_lit_noise(Play& play) {
    if (!reads_noisy_light(play)) return play.lit_noise.add_none();
    SeedRun of_a = start(play, play.variant.seeds.front()), of_b = start(play, play.variant.seeds.front());
    for (const FrameStep& step : play.shot.steps) {
        const FrameStore::Frame frame = play.store.frame(step, play.truth.lit(step));
        const auto pose = play.truth.poses.find(step.frame);
        if (pose == play.truth.poses.end()) return;  // a frame that is read but whose light is not known
        const CompositedImages a = rendered_with(play, of_a, step, frame, pose->second->lit_halves->a),
                               b = rendered_with(play, of_b, step, frame, pose->second->lit_halves->b);
        const FrameTruth* truth = play.truth.frame(step);
        if (!step.is_measured || !truth) continue;
        const std::vector<Mask> masks = masks_of(*truth, a.confidence, play.config);
        const std::string name = std::to_string(step.frame);
        if (truth->pose->frame_reference && play.shot.config.frames.size() > 1)
            play.lit_noise.add_frame(*truth->pose, a, b, masks, name);
        if (&step == &play.last_step()) play.lit_noise.add_targets(*truth->pose, a, b, masks, name);
    }
}

/// Rows of temporal metrics, which speak of `specular` over several frames.
void add_temporal_rows(Play& play, const SeedRun& run, const std::vector<TemporalScore>& scores) {
    for (const TemporalScore& s : scores) {
        if (s.pixels + s.left_out == 0) continue;  // nothing of this scene lies under the mask
        ResultRow r = play.row("all", run.seed);
        r.target = "specular", r.metric = s.metric->name, r.formula = s.formula, r.mask = s.mask;
        const auto if_finite = [](std::optional<double> v) { return v && std::isfinite(*v) ? v : std::nullopt; };
        r.value = if_finite(s.value), r.uncorrected = s.uncorrected ? if_finite(s.uncorrected) : r.value,
        r.is_corrected = s.corrected;
        r.low = if_finite(s.low), r.high = if_finite(s.high), r.pixels = s.pixels, r.non_finite = s.left_out;
        play.cell.rows.push_back(std::move(r));
        if (!s.note.empty()) play.untold[{s.metric->name, s.note}].insert(s.mask);
    }
}

void finish(Play& play, SeedRun& run) {
    for (const ResultRow& r : run.frame_rows)
        if (std::ranges::count(play.config.frame_masks, r.mask) > 0 && !is_in_full_measure(play, r))
            play.cell.rows.push_back(r);
    const std::vector<ResultRow> means = run.means.rows();
    play.cell.rows.insert(play.cell.rows.end(), means.begin(), means.end());

    const FrameTruth* last = play.truth.frame(play.last_step());
    if (!last) return;
    std::vector<Mask> masks;  // those of a single frame's confidence mean nothing over several frames
    for (const Mask& mask : last->masks)
        if (!mask.inside.empty()) masks.push_back(mask);
    if (play.shot.config.frames.size() == 1 && run.held.frames.count >= 2)
        add_temporal_rows(play, run, flicker_scores(run.held, &*last->pose->frame_reference, masks));
    if (!run.difference.sums.empty()) add_temporal_rows(play, run, run.difference.scores());
    if (!play.shot.config.change) return;
    const PoseTruth& before = *play.truth.poses.at(
        *std::ranges::find(play.shot.steps, *play.shot.config.change, &FrameStep::frame)->previous_frame);
    for (const Ghost& ghost :
         ghost_scores(run.after_change, *before.frame_reference, *last->pose->frame_reference, masks))
        add_temporal_rows(play, run, {ghost.ghost_length, ghost.settling_length});
}

void add_splits(Play& play) {
    const FrameTruth* last = play.truth.frame(play.last_step());
    if (!last) return;
    std::vector<Mask> masks;
    for (const Mask& mask : last->masks)
        if (!mask.inside.empty()) masks.push_back(mask);
    for (const auto& [target, split] : play.splits) {
        const SplitRow shared{.shot = play.shot.name(),
                              .frame = std::to_string(play.last_step().frame),
                              .variant = play.variant.variant,
                              .point = play.variant.point,
                              .target = target,
                              .mask = {}};
        for (SplitRow& row : split_rows(split, masks, shared, play.variant.depends_on_seed, play.lit_noise))
            play.cell.splits.push_back(std::move(row));
    }
}

/// Why some temporal metrics have no value.
void add_notes(Play& play) {
    for (const auto& [what, masks] : play.untold) {
        std::string note = play.shot.name() + ": " + play.variant.variant + " " + play.variant.point + ": no " +
                           what.first + ": " + what.second + " (";
        for (const std::string& mask : masks) note += (note.back() == '(' ? "" : ", ") + mask;
        play.cell.notes.push_back(note + ")");
    }
}

}  // namespace

Cell play_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
                const VariantConfig& variant, const PlaySettings& settings) {
    Play play{.device = device,
              .shot = shot,
              .truth = truth,
              .store = store,
              .config = config,
              .variant = variant,
              .settings = settings};
    if (reads_reference_light(play)) measure_lit_noise(play);
    const size_t batch = seeds_at_once(shot.config.extent);
    for (size_t first = 0; first < variant.seeds.size(); first += batch) {
        std::vector<SeedRun> runs;
        for (size_t i = first; i < std::min(first + batch, variant.seeds.size()); ++i)
            runs.push_back(start(play, variant.seeds[i]));
        for (const FrameStep& step : shot.steps) {
            const FrameStore::Frame frame = store.frame(step, truth.lit(step));
            for (SeedRun& run : runs) render_step(play, run, step, frame);
        }
        for (SeedRun& run : runs) finish(play, run);
    }
    add_splits(play);
    add_hits(play);
    play.cell.reference_noise =
        play.noise.means({.shot = shot.name(), .variant = variant.variant, .point = variant.point});
    add_notes(play);
    return std::move(play.cell);
}
