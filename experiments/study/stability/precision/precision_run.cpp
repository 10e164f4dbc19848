#include "experiments/study/stability/precision/precision_run.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/stability/amplification.h"

#include <algorithm>
#include <cmath>

namespace {

/// The G-buffer with some of its images in half.
struct RoundedInputs {
    std::unique_ptr<PassList> pass_list;
    GBuffer gbuffer;
};

RoundedInputs rounded_inputs(Device& device, const CaseFrame& frame, const std::set<std::string>& in_half) {
    RoundedInputs rounded{std::make_unique<PassList>(device, frame.host->extent()), {}};
    rounded.pass_list->set_changes(
        {.format_of = [&in_half](const std::string& image,
                                 Format asked) { return in_half.contains(image) ? as_float16(asked) : asked; },
         .glsl_of = {}});
    rounded.gbuffer = upload_gbuffer(*rounded.pass_list, *frame.host);
    rounded.gbuffer.environment = frame.gbuffer.environment;
    return rounded;
}

}  // namespace

PrecisionRun run_precisely(Device& device, const PointConfig& point, const CaseFrames& frames,
                           const PrecisionWish& wish) {
    const Renderer technique(device, frames.shot->config.extent, point);
    technique.technique->limits = Limits::none;  // not every API filters floats
    PassList& pass_list = *technique.pass_list;
    RayProbe& probe = *technique.probe;
    PrecisionRun run;
    std::optional<RoundedInputs> inputs;
    const HostGBuffer* rounded_host = nullptr;
    for (const CaseFrame& frame : frames.steps) {
        GBuffer gbuffer = frame.gbuffer;
        if (!wish.half_inputs.empty()) {
            if (frame.host.get() != rounded_host) inputs = rounded_inputs(device, frame, wish.half_inputs);
            rounded_host = frame.host.get();
            gbuffer = inputs->gbuffer;
        }
        const bool is_last = &frame == &frames.steps.back();
        probe.is_recording = wish.is_recording && is_last;
        if (is_last) probe.replayed = wish.replayed;
        // From the first frame on, so that images begin alike in all runs.
        pass_list.observe([&](const std::string& stage, std::span<const Image> written) {
            if (!is_last) return;
            if (!std::ranges::count(run.stages, stage)) run.stages.push_back(stage);
            for (const Image& image : written) {
                StageValue value{stage, pass_list.asked_name(image), image.first_mip, image.format,
                                 pass_list.download(image)};
                // A pass whose rays are recorded runs twice.
                if (StageValue* known = run.find(value))
                    *known = std::move(value);
                else
                    run.values.push_back(std::move(value));
            }
        });
        pass_list.set_changes(wish.changes);
        const Reflections reflections = technique.render(frame.camera, stability_seed, gbuffer);
        pass_list.observe({});
        pass_list.set_changes({});
        const Composite composite = technique.compositor->render(frame.gbuffer, reflections);
        if (is_last) run.specular = channels_of(pass_list.download(composite.specular), 0, 3);
    }
    run.rays = std::move(probe.recorded);
    return run;
}

StageValue* PrecisionRun::find(const StageValue& like) {
    const auto found = std::ranges::find_if(values, [&](const StageValue& value) {
        return value.stage == like.stage && value.image == like.image && value.mip == like.mip;
    });
    return found == values.end() ? nullptr : &*found;
}

void add_differences(const HostImage& a, const HostImage& b, std::vector<double>& differences) {
    for (unsigned c = 0; c < std::min(a.channels, b.channels); ++c) {
        std::vector<double> sizes;
        for (size_t i = 0; i < a.pixel_count(); ++i)
            if (const double x = a.values[i * a.channels + c]; std::isfinite(x) && x != 0) sizes.push_back(std::abs(x));
        const double nothing = sizes.empty() ? 0.0 : 1e-6 * quantile(sizes, 0.5);
        for (size_t i = 0; i < a.pixel_count(); ++i) {
            const double x = a.values[i * a.channels + c], y = b.values[i * b.channels + c];
            if (x == 0 && y == 0) continue;
            const bool are_alike = x == y || (std::isnan(x) && std::isnan(y));
            const bool are_finite = std::isfinite(x) && std::isfinite(y);
            differences.push_back(are_alike     ? 0.0
                                  : !are_finite ? 1.0
                                                : std::abs(x - y) / std::max({std::abs(x), std::abs(y), nothing}));
        }
    }
}

ValueChange value_change(std::vector<double> differences) {
    if (differences.empty()) return {};
    const auto differing = std::ranges::count_if(differences, [](double d) { return d > 0; });
    ValueChange change{.differing = double(differing) / double(differences.size())};
    change.median = quantile(differences, 0.5), change.p999 = quantile(differences, 0.999);
    return change;
}
