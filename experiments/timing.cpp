#include "experiments/timing.h"

#include "core/gpu/device.h"
#include "experiments/results.h"
#include "variants/registry.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace {

/// A variant with images and pipelines of its own, ready to render.
struct TimedVariant {
    const VariantConfig* config;
    std::unique_ptr<PassGraph> graph;
    std::unique_ptr<Variant> variant;
    std::vector<double> totals;

    TimedVariant(const VariantConfig& c, Device& device, const Shot& shot, bool keep_all)
        : config(&c), graph(std::make_unique<PassGraph>(device, shot.config.extent)), variant(make_variant(c.variant, c.parameters, c.preset)) {
        if (!keep_all) variant->leave_out(shot.facts);
    }

    std::vector<PassTime> render(const CameraData& camera, const GBuffer& gbuffer) {
        graph->begin_frame(camera, variant->params, gbuffer.images());
        variant->render(*graph, gbuffer);
        return graph->times();
    }
};

double total_of(const std::vector<PassTime>& times) {
    double sum = 0;
    for (const PassTime& t : times) sum += t.milliseconds;
    return sum;
}

}  // namespace

ShotTimes time_variants(FrameSource& source, const Shot& shot, const Config& config, const HostImage& lit, bool keep_all,
                        const std::function<void(double)>& report) {
    ShotTimes result;
    if (config.timing.frames == 0) return result;
    const unsigned frame = shot.config.frames.front();
    const unsigned seed = config.seeds.front();

    std::vector<TimedVariant> variants;
    for (const VariantConfig& v : config.variants) variants.emplace_back(v, source.graph().device(), shot, keep_all);
    // The second measurement is of the last variant: studies list the baseline, which does little, first.
    TimedVariant again(config.variants.back(), source.graph().device(), shot, keep_all);

    const std::string clock = source.graph().clock() == Clock::host_fence ? "host_fence" : "gpu_timestamp";
    const unsigned rounds = config.timing.warm_up + config.timing.frames;
    for (unsigned round = 0; round < rounds; ++round) {
        const bool is_measured = round >= config.timing.warm_up;
        const unsigned number = round - config.timing.warm_up;
        const auto add = [&](const std::string& variant, const std::string& point, const std::string& stage, double ms) {
            result.rows.push_back({.shot = shot.name(frame), .variant = variant, .point = point, .seed = seed, .stage = stage, .frame = number, .milliseconds = ms, .clock = clock});
        };
        const GBuffer gbuffer = source.render(frame, seed, lit);
        if (is_measured)
            for (const PassTime& t : source.graph().times()) add("", "", t.stage, t.milliseconds);
        for (TimedVariant& v : variants) {
            const std::vector<PassTime> times = v.render(source.camera(), gbuffer);
            if (!is_measured) continue;
            for (const PassTime& t : times) add(v.config->variant, v.config->point, t.stage, t.milliseconds);
            v.totals.push_back(total_of(times));
            add(v.config->variant, v.config->point, "total", v.totals.back());
        }
        const std::vector<PassTime> times = again.render(source.camera(), gbuffer);
        if (is_measured) again.totals.push_back(total_of(times));
        report(double(round + 1) / rounds);
    }
    const double first = median_interval(variants.back().totals).median, second = median_interval(again.totals).median;
    result.aa_floor = first > 0 ? std::abs(second - first) / first : 0.0;
    return result;
}
