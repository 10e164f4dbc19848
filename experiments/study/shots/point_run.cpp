#include "experiments/study/shots/point_run.h"

#include "core/gbuffer/composite.h"
#include "core/gpu/device.h"
#include "experiments/measuring/error_causes.h"
#include "experiments/measuring/exact_rays.h"
#include "experiments/measuring/frame_means.h"
#include "experiments/measuring/judged_hits.h"
#include "experiments/measuring/lit_noise.h"
#include "experiments/measuring/render_variant.h"
#include "experiments/measuring/splits.h"
#include "experiments/results/image_queue.h"
#include "experiments/results/result_images.h"
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

/// A variant point on its way through the shot: what all functions below need to know.
struct PointRun {
    Device& device;
    const Shot& shot;
    const ShotTruth& truth;
    FrameStore& store;
    const Config& config;
    const VariantConfig& variant;
    const PointRunSettings& settings;
    Cell cell;
    ImageQueue images = {};
    std::map<std::string, SeedSplit> splits;  ///< by target, of the last frame
    ReferenceNoiseMeans noise = {};
    LitNoises lit_noise = {};
    std::map<std::pair<std::string, std::string>, std::set<std::string>>
        untold;  ///< masks, by temporal metric and reason
    size_t rendered = 0;
    std::map<unsigned, ExactRays> exact_rays = {};  ///< by frame
    std::map<unsigned, JudgedHits> judged = {};     ///< by frame
    std::map<unsigned, ErrorCauses> causes = {};    ///< by frame

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

SeedRun start(PointRun& point, unsigned seed) {
    const VariantConfig& v = point.variant;
    SeedRun run{.seed = seed,
                .variant = make_variant(v.variant, v.parameters, v.preset),
                .probe = std::make_unique<RayProbe>(),
                .graph = std::make_unique<PassGraph>(point.device, point.shot.config.extent)};
    run.variant->ray_probe = run.probe.get();
    if (!point.settings.keep_all) run.variant->leave_out(point.shot.facts);
    run.compositor = std::make_unique<Compositor>(*run.graph, point.config.composite);
    return run;
}

/// Whether the lit colour that variants read is that of the reference.
bool reads_reference_light(const PointRun& point) {
    return !point.shot.config.direct_lit && point.truth.is_measured() &&
           std::ranges::all_of(point.truth.poses, [](const auto& pose) { return pose.second->lit_halves.has_value(); });
}

bool reads_noisy_light(const PointRun& point) {
    return reads_reference_light(point) &&
           std::ranges::any_of(point.truth.poses, [](const auto& pose) { return is_noisy(*pose.second->lit_halves); });
}

/// How many seeds' images are held at once: one, unless each frame is drawn anew whenever it is asked for. Then as many
/// as take some 0.5 GB: those of a technique are some 400 bytes per pixel, and what means over frames need 150 more.
size_t seeds_at_once(const FrameStore& store, glm::uvec2 extent) {
    constexpr size_t pixels = 1'000'000;
    return store.keeps_all() ? 1 : std::max<size_t>(1, pixels / (size_t(extent.x) * extent.y));
}

/// The full measure of the shot's last frame, its images, and its part in the split over seeds.
void measure_last(PointRun& point, const FrameTruth& truth, const CompositedImages& images, const ResultRow& row,
                  std::span<const Mask> masks) {
    std::vector<ResultRow> rows = measure_targets(*truth.pose, images, masks, row);
    point.lit_noise.set(rows);
    point.cell.rows.insert(point.cell.rows.end(), rows.begin(), rows.end());
    const HostImage image = composited_image(*truth.pose, images);
    for (const auto& [target, reference] : truth.pose->targets) {
        const HostImage& tested = tested_image(target, images, image);
        point.splits.try_emplace(target, reference).first->second.add(row.seed, tested);
        point.noise.add(row.frame, target, reference, tested, masks);
    }
}

/// Whether the full measure of the last frame holds this row already.
bool is_in_full_measure(const PointRun& point, const ResultRow& row) {
    return row.frame == std::to_string(point.last_step().frame) &&
           std::ranges::count(point.config.targets, "specular") > 0 &&
           std::ranges::count(point.config.metrics, row.metric) > 0;
}

/// A frame of several.
void measure_in_passing(PointRun& point, SeedRun& run, const PoseTruth& truth, const HostImage& specular,
                        std::span<const Mask> masks, const ResultRow& row) {
    FrameRows frame = measure_frame(truth, specular, masks, row);
    point.lit_noise.set(frame.rows);
    run.frame_rows.insert(run.frame_rows.end(), frame.rows.begin(), frame.rows.end());
    if (point.shot.config.measures_last_only) return;
    run.means.add(frame);
    point.noise.add(over_frames, "specular", *truth.frame_reference, specular, masks);
}

/// What one rendered frame adds to the results of its seed.
void measure_step(PointRun& point, SeedRun& run, const FrameStep& step, const CompositedImages& images) {
    if (step.is_held) run.held.add(images.specular);
    if (is_after_change(point.shot, step)) run.after_change.push_back(images.specular);
    const FrameTruth* truth = point.truth.frame(step);
    if (!truth) return;
    const std::vector<Mask> masks = masks_of(*truth, images.confidence, point.config);
    if (measures_difference(point.shot, step))
        run.difference.add(run.before, images.specular, *point.truth.poses.at(*step.previous_frame)->frame_reference,
                           *truth->pose->frame_reference, masks);
    if (!step.is_measured) return;
    const ResultRow row = point.row(std::to_string(step.frame), run.seed);
    if (truth->pose->frame_reference && point.shot.config.frames.size() > 1)
        measure_in_passing(point, run, *truth->pose, images.specular, masks, row);
    if (&step == &point.last_step()) measure_last(point, *truth, images, row, masks);
}

void report_step(PointRun& point) {
    const size_t runs = point.variant.seeds.size() + (reads_noisy_light(point) ? 2 : 0);
    point.settings.report(double(++point.rendered) / double(point.shot.steps.size() * runs));
}

const ExactRays& exact_rays(PointRun& point, const FrameStep& step, const CameraData& camera) {
    return point.exact_rays.try_emplace(step.frame, point.shot, step.frame, camera).first->second;
}

/// What the step's rays truly meet, for the tracer exact_scene; a capture has no scene to ask.
void plug_in_scene(PointRun& point, SeedRun& run, const FrameStep& step, const FrameStore::Frame& frame) {
    if (!point.shot.config.gbuffer.empty()) return;
    run.probe->exact_hits = [&point, &step, camera = frame.camera](const RecordedRays& recorded) {
        return exact_rays(point, step, camera).hits(recorded);
    };
}

/// Whether the images of this step are kept.
bool is_shown(const PointRun& point, const SeedRun& run, const FrameStep& step) {
    if (run.seed != point.variant.seeds.front()) return false;
    return &step == &point.last_step() || (point.config.keeps_all_images && step.is_measured);
}

void save(PointRun& point, std::function<ImageQueue::Entries()> images) {
    const SpentTime::Span span(point.settings.spent, "images");
    point.images.add(std::move(images));
}

/// What tells the images of a step from those of other steps and cells.
std::string image_suffix(const PointRun& point, const FrameStep& step) {
    const std::string of_frame = &step == &point.last_step() ? "" : ".f" + std::to_string(step.frame);
    return point.settings.image_suffix + of_frame;
}

const Mask everywhere{.name = "all", .extent = {}, .inside = {}};  // the only one that needs no truth

bool judges_rays(const PointRun& point, const SeedRun& run, const FrameStep& step) {
    const auto& seeds = point.variant.seeds;
    if (!point.variant.depends_on_seed && run.seed != seeds.front()) return false;  // it would trace the same rays
    return point.config.hits && step.is_measured && point.shot.config.gbuffer.empty() &&
           size_t(std::ranges::find(seeds, run.seed) - seeds.begin()) < point.config.hits->seeds;
}

/// What `specular` is compared with; null where it is not measured.
const MetricReference* specular_reference(const PoseTruth& pose) {
    const auto found = pose.targets.find("specular");
    return found != pose.targets.end() ? &found->second : pose.frame_reference ? &*pose.frame_reference : nullptr;
}

/// The rays that were recorded in this step against what they truly meet, and the error that lies on their pixels.
void judge_rays(PointRun& point, SeedRun& run, const FrameStep& step, const CameraData& camera,
                const HostImage& specular, std::span<const Mask> masks) {
    const FrameTruth* frame_truth = point.truth.frame(step);
    const MetricReference* reference = frame_truth ? specular_reference(*frame_truth->pose) : nullptr;
    const bool has_causes = reference && point.config.hits->every == 1;  // neighbours' rays are needed
    const ResultRow row = point.row(std::to_string(step.frame), run.seed);
    for (const RecordedRays& recorded : run.probe->recorded) {
        const std::vector<ExactHit> truth = exact_rays(point, step, camera).hits(recorded, point.config.hits->every);
        point.judged[step.frame].add(run.seed, recorded, truth, point.shot.config.extent, point.config.hits->every,
                                     {masks.begin(), masks.end()});
        if (has_causes) point.causes[step.frame].add(recorded, truth, point.shot.config.extent);
        if (is_shown(point, run, step) && point.config.hits->every == 1)
            save(point, [&out = point.settings.out, row, suffix = image_suffix(point, step), stage = recorded.stage,
                         map = map_of_verdicts(recorded, truth, point.shot.config.extent)] {
                return ImageQueue::Entries{save_verdict_image(out, row, suffix, stage, map)};
            });
    }
    if (has_causes) point.causes[step.frame].finish(*reference, specular, {masks.begin(), masks.end()});
    run.probe->recorded.clear();
}

void add_hits(PointRun& point) {
    for (const auto& [frame, judged] : point.judged) {
        const HitRow shared{.shot = point.shot.name(),
                            .frame = std::to_string(frame),
                            .variant = point.variant.variant,
                            .point = point.variant.point,
                            .stage = {},
                            .mask = {},
                            .quantity = {},
                            .low = {},
                            .high = {}};
        for (HitRow& row : judged.rows(shared)) point.cell.hits.push_back(std::move(row));
        if (const auto causes = point.causes.find(frame); causes != point.causes.end())
            for (HitRow& row : causes->second.rows(shared)) point.cell.hits.push_back(std::move(row));
    }
}

void render_step(PointRun& point, SeedRun& run, const FrameStep& step, const FrameStore::Frame& frame) {
    plug_in_scene(point, run, step, frame);
    run.probe->is_recording = judges_rays(point, run, step);
    const Reflections reflections = render_variant(*run.graph, *run.variant, frame.camera, run.seed, frame.gbuffer);
    if (!step.is_warm_up) {
        const Composite composite = run.compositor->render(frame.gbuffer, reflections);
        const FrameTruth* truth = point.truth.frame(step);
        const CompositedImages images = download_results(*run.graph, frame.gbuffer, reflections, composite,
                                                         truth ? truth->reflectance : HostImage{});
        measure_step(point, run, step, images);
        if (run.probe->is_recording)
            judge_rays(point, run, step, frame.camera, images.specular,
                       truth ? masks_of(*truth, images.confidence, point.config) : std::vector<Mask>{everywhere});
        if (is_shown(point, run, step) && point.config.has_reference)
            save(point, [&point, row = point.row(std::to_string(step.frame), run.seed),
                         suffix = image_suffix(point, step), &truth = point.truth.pose(step), images] {
                return save_result_images(point.settings.out, row, suffix, truth, images,
                                          point.shot.camera.exposure_ev);
            });
        run.before = images.specular;
    }
    report_step(point);
}

/// The result of a step for which the variant reads `lit` (RGB).
CompositedImages rendered_with(PointRun& point, SeedRun& run, const FrameStep& step, FrameStore::Frame frame,
                               const HostImage& lit) {
    HostImage rgba(lit.extent, 4);
    for (size_t i = 0; i < lit.pixel_count(); ++i) rgba.set_rgb(i, lit.rgb(i));
    plug_in_scene(point, run, step, frame);
    frame.gbuffer.lit = run.graph->image("lit_of_half", Format::rgba32f).as("lit");
    run.graph->upload(frame.gbuffer.lit, rgba);
    const Reflections reflections = render_variant(*run.graph, *run.variant, frame.camera, run.seed, frame.gbuffer);
    report_step(point);
    const FrameTruth* truth = point.truth.frame(step);
    if (!step.is_measured || !truth) return {};
    const Composite composite = run.compositor->render(frame.gbuffer, reflections);
    return download_results(*run.graph, frame.gbuffer, reflections, composite, truth->reflectance);
}

/// Plays the shot with the light of each half of the reference, to tell what the noise of the light adds.
void measure_lit_noise(PointRun& point) {
    if (!reads_noisy_light(point)) return point.lit_noise.add_none();
    SeedRun of_a = start(point, point.variant.seeds.front()), of_b = start(point, point.variant.seeds.front());
    for (const FrameStep& step : point.shot.steps) {
        const FrameStore::Frame frame = point.store.frame(step, point.truth.lit(step));
        const auto pose = point.truth.poses.find(step.frame);
        if (pose == point.truth.poses.end()) return;  // a frame that is read but whose light is not known
        const CompositedImages a = rendered_with(point, of_a, step, frame, pose->second->lit_halves->a),
                               b = rendered_with(point, of_b, step, frame, pose->second->lit_halves->b);
        const FrameTruth* truth = point.truth.frame(step);
        if (!step.is_measured || !truth) continue;
        const std::vector<Mask> masks = masks_of(*truth, a.confidence, point.config);
        const std::string name = std::to_string(step.frame);
        if (truth->pose->frame_reference && point.shot.config.frames.size() > 1)
            point.lit_noise.add_frame(*truth->pose, a, b, masks, name);
        if (&step == &point.last_step()) point.lit_noise.add_targets(*truth->pose, a, b, masks, name);
    }
}

/// Rows of temporal metrics, which speak of `specular` over several frames.
void add_temporal_rows(PointRun& point, const SeedRun& run, const std::vector<TemporalScore>& scores) {
    for (const TemporalScore& s : scores) {
        if (s.pixels + s.left_out == 0) continue;  // nothing of this scene lies under the mask
        ResultRow r = point.row(over_frames, run.seed);
        r.target = "specular", r.metric = s.metric->name, r.formula = s.formula, r.mask = s.mask;
        const auto if_finite = [](std::optional<double> v) { return v && std::isfinite(*v) ? v : std::nullopt; };
        r.value = if_finite(s.value), r.uncorrected = s.uncorrected ? if_finite(s.uncorrected) : r.value,
        r.is_corrected = s.corrected;
        r.low = if_finite(s.low), r.high = if_finite(s.high), r.pixels = s.pixels, r.non_finite = s.left_out;
        point.cell.rows.push_back(std::move(r));
        if (!s.note.empty()) point.untold[{s.metric->name, s.note}].insert(s.mask);
    }
}

void finish(PointRun& point, SeedRun& run) {
    for (const ResultRow& r : run.frame_rows)
        if (std::ranges::count(point.config.frame_masks, r.mask) > 0 && !is_in_full_measure(point, r))
            point.cell.rows.push_back(r);
    const std::vector<ResultRow> means = run.means.rows();
    point.cell.rows.insert(point.cell.rows.end(), means.begin(), means.end());

    const FrameTruth* last = point.truth.frame(point.last_step());
    if (!last) return;
    std::vector<Mask> masks;  // those of a single frame's confidence mean nothing over several frames
    for (const Mask& mask : last->masks)
        if (!mask.inside.empty()) masks.push_back(mask);
    if (point.shot.config.frames.size() == 1 && run.held.frames.count >= 2)
        add_temporal_rows(point, run, flicker_scores(run.held, &*last->pose->frame_reference, masks));
    if (!run.difference.sums.empty()) add_temporal_rows(point, run, run.difference.scores());
    if (!point.shot.config.change) return;
    const PoseTruth& before = *point.truth.poses.at(
        *std::ranges::find(point.shot.steps, *point.shot.config.change, &FrameStep::frame)->previous_frame);
    for (const Ghost& ghost :
         ghost_scores(run.after_change, *before.frame_reference, *last->pose->frame_reference, masks))
        add_temporal_rows(point, run, {ghost.ghost_length, ghost.settling_length});
}

void add_splits(PointRun& point) {
    const FrameTruth* last = point.truth.frame(point.last_step());
    if (!last) return;
    std::vector<Mask> masks;
    for (const Mask& mask : last->masks)
        if (!mask.inside.empty()) masks.push_back(mask);
    for (const auto& [target, split] : point.splits) {
        const SplitRow shared{.shot = point.shot.name(),
                              .frame = std::to_string(point.last_step().frame),
                              .variant = point.variant.variant,
                              .point = point.variant.point,
                              .target = target,
                              .mask = {}};
        for (SplitRow& row : split_rows(split, masks, shared, point.variant.depends_on_seed, point.lit_noise))
            point.cell.splits.push_back(std::move(row));
    }
}

/// Why some temporal metrics have no value.
void add_notes(PointRun& point) {
    for (const auto& [what, masks] : point.untold) {
        std::string note = point.shot.name() + ": " + point.variant.variant + " " + point.variant.point + ": no " +
                           what.first + ": " + what.second + " (";
        for (const std::string& mask : masks) note += (note.back() == '(' ? "" : ", ") + mask;
        point.cell.notes.push_back(note + ")");
    }
}

}  // namespace

Cell run_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
               const VariantConfig& variant, const PointRunSettings& settings) {
    PointRun point{.device = device,
                   .shot = shot,
                   .truth = truth,
                   .store = store,
                   .config = config,
                   .variant = variant,
                   .settings = settings};
    if (reads_reference_light(point)) measure_lit_noise(point);
    const size_t batch = seeds_at_once(store, shot.config.extent);
    for (size_t first = 0; first < variant.seeds.size(); first += batch) {
        std::vector<SeedRun> runs;
        for (size_t i = first; i < std::min(first + batch, variant.seeds.size()); ++i)
            runs.push_back(start(point, variant.seeds[i]));
        for (const FrameStep& step : shot.steps) {
            const FrameStore::Frame frame = store.frame(step, truth.lit(step));
            for (SeedRun& run : runs) render_step(point, run, step, frame);
        }
        for (SeedRun& run : runs) finish(point, run);
    }
    add_splits(point);
    add_hits(point);
    point.cell.reference_noise =
        point.noise.means({.shot = shot.name(), .variant = variant.variant, .point = variant.point});
    add_notes(point);
    const SpentTime::Span span(settings.spent, "images");
    point.cell.images = point.images.finish();
    return std::move(point.cell);
}
