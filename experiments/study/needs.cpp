#include "experiments/study/needs.h"

#include "core/gbuffer/rasterizer.h"
#include "experiments/study/measuring/render_technique.h"
#include "groundtruth/paths/path_tracer.h"
#include "variants/registry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

namespace {

std::unique_ptr<Technique> make(const PointConfig& v) { return make_technique(v.technique, v.parameters, v.preset); }

/// A point with images of its own.
struct Copy {
    PassList pass_list;
    std::unique_ptr<Technique> technique;

    Copy(PassList& like, const PointConfig& config)
        : pass_list(like.device(), like.extent()), technique(make(config)) {}

    /// Radiance times confidence, confidence.
    HostImage render(const CameraData& camera, const GBuffer& gbuffer) {
        const Reflections reflections = render_technique(pass_list, *technique, camera, 1, gbuffer);
        const HostImage radiance = pass_list.download(reflections.radiance),
                        confidence = pass_list.download(reflections.confidence);
        HostImage weighed(radiance.extent, 4);
        for (size_t i = 0; i < weighed.pixel_count(); ++i) {
            const float share = confidence.values[i * confidence.channels + reflections.confidence_channel];
            weighed.set_rgb(i, share * radiance.rgb(i));
            weighed.values[i * 4 + 3] = share;
        }
        return weighed;
    }
};

void compare(const HostImage& lean, const HostImage& complete, MeasuredSaving& saving) {
    if (std::memcmp(lean.values.data(), complete.values.data(), lean.values.size() * sizeof(float)) == 0) return;
    saving.has_same_bits = false;
    float largest = 0.0f, difference = 0.0f;
    for (size_t i = 0; i < lean.values.size(); ++i) {
        const float a = lean.values[i], b = complete.values[i];
        if (std::isnan(a) && std::isnan(b)) continue;
        largest = std::max(largest, std::abs(b));
        difference = std::isfinite(a - b) ? std::max(difference, std::abs(a - b)) : INFINITY;
    }
    saving.largest_difference = std::max(saving.largest_difference, largest > 0 ? difference / largest : difference);
}

HostImage mean_of(const HostImage& image) {
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < image.pixel_count(); ++i) sum += glm::dvec3(image.rgb(i));
    HostImage mean({1, 1}, 3);
    mean.set_rgb(0, glm::vec3(sum / double(image.pixel_count())));
    return mean;
}

Saving saving_of(const std::string& who, const std::vector<double>& lean, const std::vector<double>& complete) {
    std::vector<double> shares;
    for (size_t i = 0; i < lean.size(); ++i) shares.push_back(1 - lean[i] / complete[i]);
    return {.technique = who,
            .point = "",
            .complete_ms = median_interval(complete).value,
            .share = median_interval(shares)};
}

MeasuredSaving measure_rasterizer(Device& device, const Shot& shot, unsigned frames) {
    const RasterizerOptions lean_options{.extent = shot.config.extent, .is_still = shot.facts.is_still()};
    RasterizerOptions complete_options = lean_options;
    complete_options.keep_all = true;
    Rasterizer lean(device, shot.scene, lean_options), complete(device, shot.scene, complete_options);
    MeasuredSaving saving;
    std::vector<double> milliseconds[2];
    const unsigned warm_up = 2;
    for (const FrameStep& step : timed_steps(shot.config.frames, warm_up + frames)) {
        const FrameView view{.extent = shot.config.extent,
                             .frame = step.frame,
                             .index = step.index,
                             .previous_frame = step.previous_frame};
        std::vector<HostImage> images[2];
        Rasterizer* const rasterizers[2] = {&lean, &complete};
        for (const unsigned i : {step.index % 2, 1 - step.index % 2}) {
            const GBuffer gbuffer = rasterizers[i]->render(shot.camera, view);
            if (step.index >= warm_up) milliseconds[i].push_back(rasterizers[i]->pass_list().frame_milliseconds());
            for (const Image& image : gbuffer.images())
                images[i].push_back(rasterizers[i]->pass_list().download(image));
        }
        for (size_t i = 0; i < images[0].size(); ++i) compare(images[0][i], images[1][i], saving);
    }
    saving.time = saving_of("rasteriser", milliseconds[0], milliseconds[1]);
    return saving;
}

/// One thread's time, for a sample of the pixels. Embree rounds hits otherwise where it calls filters, and a path that
/// rounding turns elsewhere is another path: what must agree is the mean over the image.
MeasuredSaving measure_path_tracer(const Shot& shot, unsigned rounds) {
    using Clock = std::chrono::steady_clock;
    const ShotFrame now = shot_frame(shot, shot.config.frames.front());
    const glm::uvec2 extent = shot.config.extent;
    const PathTracer lean(shot.scene, now.scene, now.camera, extent, {}),
        complete(shot.scene, now.scene, now.camera, extent, {.keep_all = true});
    const PathTracer* const tracers[2] = {&lean, &complete};
    constexpr unsigned samples = 4, most_pixels = 10000;
    const unsigned step = unsigned(std::ceil(std::sqrt(double(extent.x) * extent.y / most_pixels)));
    MeasuredSaving saving;
    std::vector<double> milliseconds[2];
    for (unsigned round = 0; round < rounds; ++round) {
        HostImage sums[2];
        for (const unsigned i : {round % 2, 1 - round % 2}) {
            sums[i] = HostImage((extent + step - 1u) / step, 3);
            const auto start = Clock::now();
            for (unsigned y = 0; y < extent.y; y += step)
                for (unsigned x = 0; x < extent.x; x += step) {
                    PixelEstimate estimate;
                    tracers[i]->trace(x, y, tracers[i]->first_hit(x, y), 1, round * samples, samples, estimate);
                    sums[i].set_rgb(size_t(y / step) * sums[i].extent.x + x / step,
                                    glm::vec3(estimate.diffuse + estimate.specular + estimate.incident));
                }
            milliseconds[i].push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        }
        compare(mean_of(sums[0]), mean_of(sums[1]), saving);
    }
    saving.keeps_bits = false;
    saving.time = saving_of("path tracer", milliseconds[0], milliseconds[1]);
    return saving;
}

}  // namespace

bool MeasuredSaving::is_as_said() const {
    return has_same_bits || (!keeps_bits && largest_difference <= rounding_difference);
}

Config timed_config(const std::vector<PointConfig>& points, unsigned frames) {
    Config config;
    config.techniques = points;
    config.has_reference = false;
    config.timing.frames = frames;
    return config;
}

MeasuredSaving compare_with_all_kept(FrameSource& source, const Shot& shot, const PointConfig& point) {
    constexpr unsigned frames = 4;
    Copy lean(source.pass_list(), point), complete(source.pass_list(), point);
    MeasuredSaving saving;
    saving.keeps_bits = std::ranges::all_of(lean.technique->leave_out(shot.facts), &LeftOut::keeps_bits);
    saving.repeats_itself = lean.technique->not_repeatable().empty();
    if (!saving.repeats_itself) return saving;
    for (const FrameStep& step : timed_steps(shot.config.frames, frames)) {
        const GBuffer gbuffer = source.render(step, 0, {});
        compare(lean.render(source.camera(), gbuffer), complete.render(source.camera(), gbuffer), saving);
    }
    return saving;
}

MeasuredSavings measure_savings(Device& device, const Shot& shot, const std::vector<PointConfig>& points,
                                unsigned frames, const std::function<void(double)>& report) {
    std::vector<MeasuredSaving> all;
    const std::vector<LeftOutBy> left_out = left_out_of(shot, points);
    const auto leaves_out = [&](const std::string& who) {
        return std::ranges::any_of(left_out, [&](const LeftOutBy& part) { return part.who == who; });
    };
    if (leaves_out("path tracer")) all.push_back(measure_path_tracer(shot, frames));
    if (leaves_out("rasteriser")) all.push_back(measure_rasterizer(device, shot, frames));
    report(0.1);

    const Config config = timed_config(points, frames);
    const std::unique_ptr<FrameSource> source = scene_source(device, shot, config, false);
    const HostImage unused;
    const ShotTimes times = time_techniques(
        *source, shot, config, [&](unsigned) -> const HostImage& { return unused; }, false,
        std::numeric_limits<double>::infinity(), [&](double share) { report(0.1 + 0.8 * share); });
    for (const Saving& time : times.savings) {
        const auto point = std::ranges::find_if(
            points, [&](const PointConfig& v) { return v.technique == time.technique && v.point == time.point; });
        all.push_back(compare_with_all_kept(*source, shot, *point));
        all.back().time = time;
    }
    return {all, times.saved, times.load};
}
