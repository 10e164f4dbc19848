#include "experiments/stability/case_run.h"

#include "core/error.h"
#include "core/gbuffer/composite.h"
#include "experiments/config/config.h"
#include "experiments/config/point_name.h"
#include "experiments/measuring/render_variant.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <cmath>

namespace {

/// Rounding of the formats that techniques store radiance in: of r11g11b10f's blue 2^-6, twice.
constexpr float brighter_than_all = 1.04f;

struct FrameImages {
    HostImage specular, radiance, confidence;
};

float brightest(const HostGBuffer& gbuffer) {
    float most = 0.0f;
    for (const HostImage* image : {&gbuffer.lit, &gbuffer.fallback})
        for (size_t i = 0; i < image->pixel_count(); ++i) {
            const glm::vec3 c = image->rgb(i);
            if (is_finite(c)) most = std::max({most, c.x, c.y, c.z});
        }
    return most;
}

void judge(CaseResult& run, const FrameImages& frame, const HostGBuffer& gbuffer, float most, bool is_after_faults) {
    size_t spread = 0;
    for (size_t i = 0; i < frame.specular.pixel_count(); ++i) {
        if (!is_sound(gbuffer, i)) continue;
        const glm::vec3 radiance = frame.radiance.rgb(i);
        const float confidence = frame.confidence.values[i];
        if (!is_finite(radiance) || !std::isfinite(confidence) || !is_finite(frame.specular.rgb(i))) {
            ++spread;
            continue;
        }
        const float least = std::min({radiance.x, radiance.y, radiance.z});
        const float brightest = confidence * std::max({radiance.x, radiance.y, radiance.z});  // as it is composited
        const bool is_bright = brightest > brighter_than_all * most;
        if (is_bright) run.excess = std::max(run.excess, brightest - most);
        run.negative += least < 0, run.too_bright += is_bright;
        run.bad_confidence += confidence < 0 || confidence > 1;
    }
    run.spread_pixels = std::max(run.spread_pixels, spread);
    run.spread_frames += is_after_faults && spread > 0;
}

FrameImages render(PassGraph& graph, Variant& variant, Compositor& compositor, const CaseFrame& frame, unsigned seed,
                   StageScan* scan, double& milliseconds) {
    if (scan) scan->resume();
    const Reflections reflections = render_variant(graph, variant, frame.camera, seed, frame.gbuffer);
    milliseconds = graph.frame_milliseconds();
    if (scan) scan->pause();  // what the compositor makes of a bad pixel is no stage of the technique
    const Composite composite = compositor.render(frame.gbuffer, reflections);
    return {.specular = channels_of(graph.download(composite.specular), 0, 3),
            .radiance = channels_of(graph.download(reflections.radiance), 0, 3),
            .confidence = channels_of(graph.download(reflections.confidence), reflections.confidence_channel, 1)};
}

double mean_of_judged(const CaseFrames& frames, const HostImage& specular) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < specular.pixel_count(); ++i)
        if (const glm::vec3 c = specular.rgb(i); frames.is_judged[i] && is_finite(c))
            sum += double(c.x + c.y + c.z) / 3, ++count;
    return count ? sum / double(count) : 0.0;
}

void render_all(CaseResult& run, Device& device, Variant& variant, const CaseFrames& frames, const StabilityCase& what,
                const CaseOptions& options) {
    const glm::uvec2 extent = frames.steps.front().host->extent();
    PassGraph graph(device, extent);
    std::optional<StageScan> scan;
    if (options.is_scanned) scan.emplace(graph);
    Compositor compositor(graph);
    unsigned last_fault = 0;
    for (const InputFault& fault : what.faults) last_fault = std::max(last_fault, fault.step.value_or(1u << 31));
    HostImage fed_back;
    for (size_t step = 0; step < frames.steps.size(); ++step) {
        CaseFrame frame = frames.steps[step];
        std::optional<PassGraph> mirror;
        if (!fed_back.values.empty()) {
            mirror.emplace(device, extent);
            HostImage rgba(extent, 4, 1.0f);
            for (size_t i = 0; i < rgba.pixel_count(); ++i) rgba.set_rgb(i, fed_back.rgb(i));
            frame.gbuffer.lit = mirror->image("lit", Format::rgba32f);
            mirror->upload(frame.gbuffer.lit, rgba);
        }
        double milliseconds = 0;
        const bool is_looked_at = step < 32 || step % 16 == 0;  // of long sequences some frames are enough
        FrameImages images = render(graph, variant, compositor, frame, options.seed,
                                    scan && is_looked_at ? &*scan : nullptr, milliseconds);
        run.milliseconds = step ? std::min(run.milliseconds, milliseconds) : milliseconds;
        const float most = what.feeds_back ? std::numeric_limits<float>::max() : brightest(*frame.host);
        judge(run, images, *frame.host, most, step > last_fault);
        run.means.push_back(mean_of_judged(frames, images.specular));
        if (what.feeds_back) {
            // The lit colour is the frame's own, without reflections, so that light takes one mirror more each time.
            fed_back = HostImage(extent, 3);
            for (size_t i = 0; i < fed_back.pixel_count(); ++i)
                fed_back.set_rgb(i, frames.steps[step].host->lit.rgb(i) + images.specular.rgb(i));
        }
        run.specular = std::move(images.specular);
    }
    if (!scan) return;
    run.stages = scan->findings();
    run.non_finite = scan->non_finite(), run.first_non_finite = scan->first_non_finite();
}

}  // namespace

bool is_finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string StabilityPoint::label() const {
    if (!preset.empty()) return preset;
    return parameters.empty() ? "default" : label_of(parameters);
}

std::vector<StabilityPoint> stability_points() {
    std::vector<StabilityPoint> points;
    for (const VariantEntry& entry : variant_table()) {
        if (entry.presets.empty() || entry.name == "mcguire_dda") points.push_back({entry.name, ""});
        for (const Preset& preset : entry.presets) points.push_back({entry.name, preset.name});
        if (entry.name != "mcguire_dda") continue;
        for (const TracerEntry& tracer : tracer_table())
            if (tracer.name != "exact_scene" && tracer.name != "dda")
                points.push_back({entry.name, "", {{"tracer", tracer.name}}});
    }
    return points;
}

CaseResult run_case(Device& device, const StabilityPoint& point, const StabilityCase& what, const CaseFrames& frames,
                    const CaseOptions& options, const CaseFrames* before) {
    CaseResult run;
    try {
        const std::unique_ptr<Variant> variant = make_variant(point.variant, point.parameters, point.preset);
        RayProbe probe;
        variant->ray_probe = &probe;
        if (before) {
            CaseResult smaller;
            render_all(smaller, device, *variant, *before, what, {});
        }
        render_all(run, device, *variant, frames, what, options);
    } catch (const Error& error) {
        run.refusal = error.what();
    }
    return run;
}

std::optional<double> relative_error(const CaseFrames& frames, const HostImage& specular) {
    if (frames.truth.values.empty()) return std::nullopt;
    double error = 0, truth = 0;
    for (size_t i = 0; i < specular.pixel_count(); ++i) {
        if (!frames.is_judged[i] || !is_finite(specular.rgb(i))) continue;
        const glm::dvec3 t(frames.truth.rgb(i)), difference = glm::dvec3(specular.rgb(i)) - t;
        error += glm::dot(difference, difference), truth += glm::dot(t, t);
    }
    if (truth == 0) return std::nullopt;
    return error / truth;
}
