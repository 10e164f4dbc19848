#include "experiments/study/shots/point_renders.h"

#include "core/gpu/device.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/shots/image_queue.h"
#include "experiments/study/shots/point_errors.h"
#include "experiments/study/shots/point_rays.h"
#include "experiments/study/shots/result_images.h"

#include <algorithm>

namespace {

const Mask everywhere{.name = "all", .extent = {}, .inside = {}};  // the only one that needs no truth

/// One seed on its way through the shot.
struct SeedInShot {
    Renderer renderer;
    SeedErrors errors;
    unsigned seed() const { return errors.seed; }
};

/// Whether the lit colour that techniques read is that of the reference.
bool reads_reference_light(const PointInShot& point) {
    return !point.shot.config.direct_lit && point.truth.is_measured() &&
           std::ranges::all_of(point.truth.poses, [](const auto& pose) { return pose.second->lit_halves.has_value(); });
}

bool reads_noisy_light(const PointInShot& point) {
    return reads_reference_light(point) &&
           std::ranges::any_of(point.truth.poses, [](const auto& pose) { return is_noisy(*pose.second->lit_halves); });
}

/// How many seeds' images are held at once: one, unless each frame is drawn anew whenever it is asked for. Then as many
/// as take some 0.5 GB: those of a technique are some 400 bytes per pixel, and what means over frames need 150 more.
size_t seeds_at_once(const FrameStore& store, glm::uvec2 extent, bool has_video) {
    const double bytes = (550 + (has_video ? VideoJod::bytes_per_pixel() : 0)) * extent.x * extent.y;
    return store.keeps_all() ? 1 : std::max<size_t>(1, size_t(550e6 / bytes));
}

/// The frames of a point: renders them, and hands them on to be measured, judged and kept as images.
class PointRenders {
public:
    PointRenders(Device& device, const PointInShot& point, FrameStore& store, const PointSettings& settings)
        : device_(device), point_(point), store_(store), settings_(settings), rays_(point) {}

    Cell render() {
        PointErrors errors(point_, lit_noise());
        const std::vector<unsigned>& seeds = point_.technique.seeds;
        const size_t batch =
            seeds_at_once(store_, point_.shot.config.extent, measures_video(point_.shot.config, point_.config));
        for (size_t first = 0; first < seeds.size(); first += batch) {
            std::vector<SeedInShot> open;
            for (size_t i = first; i < std::min(first + batch, seeds.size()); ++i)
                open.push_back({renderer(), {.seed = seeds[i]}});
            for (const FrameStep& step : point_.shot.steps) {
                const FrameStore::Frame frame = store_.frame(step, point_.truth.lit(step));
                for (SeedInShot& seed : open) render_step(seed, errors, step, frame);
            }
            for (SeedInShot& seed : open) errors.add_whole(seed.errors);
        }
        Cell cell;
        errors.move_to(cell);
        cell.hits = rays_.rows();
        const SpentTime::Span span(settings_.spent, "images");
        cell.images = images_.finish();
        return cell;
    }

private:
    Renderer renderer() const {
        Renderer made(device_, point_.shot.config.extent, point_.technique, point_.config.composite);
        if (!settings_.keep_all) made.technique->leave_out(point_.shot.facts);
        return made;
    }

    void report_step() {
        const bool is_played_with_halves = point_.config.measures_lit_noise && reads_noisy_light(point_);
        const size_t passes = point_.technique.seeds.size() + (is_played_with_halves ? 2 : 0);
        settings_.report(double(++rendered_) / double(point_.shot.steps.size() * passes));
    }

    /// The images of this step that are kept.
    StepImages kept_images(unsigned seed, const FrameStep& step) const {
        if (seed != point_.technique.seeds.front()) return StepImages::none;
        return point_.shot.images_of(step, point_.config.kept_images);
    }

    /// In the names of a step's images, which other steps and cells would name alike.
    std::string image_suffix(const FrameStep& step) const {
        const std::string of_frame = point_.is_last(step) ? "" : ".f" + std::to_string(step.frame);
        return settings_.image_suffix + of_frame;
    }

    void save(std::function<ImageQueue::Entries()> images) {
        const SpentTime::Span span(settings_.spent, "images");
        images_.add(std::move(images));
    }

    void save_images(unsigned seed, const FrameStep& step, const CompositedImages& images) {
        const StepImages kept = kept_images(seed, step);
        if (kept == StepImages::none) return;
        const ResultRow row = point_.row(std::to_string(step.frame), seed);
        if (kept == StepImages::all)
            save([this, row, suffix = image_suffix(step), &truth = point_.truth.pose(step), images] {
                return save_result_images(settings_.out, row, suffix, truth, images, point_.shot.camera.exposure_ev);
            });
        else
            save([this, row, suffix = image_suffix(step), specular = images.specular] {
                return ImageQueue::Entries{
                    save_played_image(settings_.out, row, suffix, specular, point_.shot.camera.exposure_ev)};
            });
    }

    /// The rays that were recorded in this step against what they truly meet.
    void judge_rays(SeedInShot& seed, const FrameStep& step, const CameraData& camera, const CompositedImages& images) {
        const FrameTruth* truth = point_.truth.frame(step);
        const std::vector<Mask> masks =
            truth ? masks_of(*truth, images.confidence, point_.config) : std::vector<Mask>{everywhere};
        std::vector<RecordedRays>& recorded = seed.renderer.probe->recorded;
        for (PointRays::VerdictMap& verdicts : rays_.judge(seed.seed(), recorded, step, camera, images.specular, masks,
                                                           kept_images(seed.seed(), step) == StepImages::all))
            save([&out = settings_.out, row = point_.row(std::to_string(step.frame), seed.seed()),
                  suffix = image_suffix(step), verdicts = std::move(verdicts)] {
                return ImageQueue::Entries{save_verdict_image(out, row, suffix, verdicts.stage, verdicts.map)};
            });
        recorded.clear();
    }

    void render_step(SeedInShot& seed, PointErrors& errors, const FrameStep& step, const FrameStore::Frame& frame) {
        Renderer& r = seed.renderer;
        rays_.plug_in_scene(*r.probe, *r.pass_list, step, frame.camera, frame.gbuffer, seed.seed());
        r.probe->is_recording = rays_.judges(seed.seed(), step);
        const Reflections reflections = r.render(frame.camera, seed.seed(), frame.gbuffer);
        if (!step.is_warm_up) {
            const Composite composite = r.compositor->render(frame.gbuffer, reflections);
            const FrameTruth* truth = point_.truth.frame(step);
            const CompositedImages images = download_results(*r.pass_list, frame.gbuffer, reflections, composite,
                                                             truth ? truth->reflectance : HostImage{});
            errors.add(seed.errors, step, images);
            if (r.probe->is_recording) judge_rays(seed, step, frame.camera, images);
            if (point_.config.has_reference) save_images(seed.seed(), step, images);
        }
        report_step();
    }

    /// The result of a step for which the technique reads `lit` (RGB).
    CompositedImages rendered_with(Renderer& r, const FrameStep& step, FrameStore::Frame frame, const HostImage& lit) {
        HostImage rgba(lit.extent, 4);
        for (size_t i = 0; i < lit.pixel_count(); ++i) rgba.set_rgb(i, lit.rgb(i));
        const auto replace = [&](Image& image) {
            const std::string name = image.name;
            image = r.pass_list->image(name + "_of_half", Format::rgba32f).as(name);
            r.pass_list->upload(image, rgba);
        };
        if (Image& without = frame.gbuffer.lit_without_specular; without.storage) {
            const HostImage with = r.pass_list->download(frame.gbuffer.lit), mean = r.pass_list->download(without);
            replace(without);
            for (size_t i = 0; i < rgba.values.size(); ++i) rgba.values[i] += with.values[i] - mean.values[i];
        }
        replace(frame.gbuffer.lit);
        const unsigned seed = point_.technique.seeds.front();
        rays_.plug_in_scene(*r.probe, *r.pass_list, step, frame.camera, frame.gbuffer, seed);
        const Reflections reflections = r.render(frame.camera, seed, frame.gbuffer);
        report_step();
        const FrameTruth* truth = point_.truth.frame(step);
        if (!step.is_measured || !truth) return {};
        const Composite composite = r.compositor->render(frame.gbuffer, reflections);
        return download_results(*r.pass_list, frame.gbuffer, reflections, composite, truth->reflectance);
    }

    /// Plays the shot with the light of each half of the reference: what the noise of the light adds to errors.
    LitNoiseOfErrors lit_noise() {
        LitNoiseOfErrors noise = unknown_lit_noise;
        if (!reads_reference_light(point_)) return noise;
        if (!reads_noisy_light(point_)) return {};
        if (!point_.config.measures_lit_noise) return noise;
        Renderer of_a = renderer(), of_b = renderer();
        for (const FrameStep& step : point_.shot.steps) {
            const FrameStore::Frame frame = store_.frame(step, point_.truth.lit(step));
            const auto pose = point_.truth.poses.find(step.frame);
            if (pose == point_.truth.poses.end()) return noise;  // a frame that is read but whose light is not known
            const CompositedImages a = rendered_with(of_a, step, frame, pose->second->lit_halves->a),
                                   b = rendered_with(of_b, step, frame, pose->second->lit_halves->b);
            const FrameTruth* truth = point_.truth.frame(step);
            if (!step.is_measured || !truth) continue;
            const std::vector<Mask> masks = masks_of(*truth, a.confidence, point_.config);
            const std::string name = std::to_string(step.frame);
            if (truth->pose->frame_reference && point_.shot.config.frames.size() > 1)
                add_lit_noise_of_frame(noise, *truth->pose, a, b, masks, name);
            if (point_.is_last(step)) add_lit_noise_of_targets(noise, *truth->pose, a, b, masks, name);
        }
        return noise;
    }

    Device& device_;
    const PointInShot& point_;
    FrameStore& store_;
    const PointSettings& settings_;
    PointRays rays_;
    ImageQueue images_;
    size_t rendered_ = 0;
};

}  // namespace

Cell render_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
                  const PointConfig& technique, const PointSettings& settings) {
    const PointInShot point{.shot = shot, .truth = truth, .config = config, .technique = technique};
    return PointRenders(device, point, store, settings).render();
}
