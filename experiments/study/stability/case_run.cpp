#include "experiments/study/stability/case_run.h"

#include "core/error.h"
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/spirv/zero_products.h"
#include "experiments/study/measuring/render_technique.h"

#include <algorithm>
#include <cmath>
#include <mutex>

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

void judge(CaseFindings& run, const FrameImages& frame, const HostGBuffer& gbuffer, float most, bool is_after_faults) {
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
        if (is_bright) run.excess = std::max(run.excess, double(brightest - most));
        run.negative += least < 0, run.too_bright += is_bright;
        run.bad_confidence += confidence < 0 || confidence > 1;
    }
    run.spread_pixels = std::max(run.spread_pixels, spread);
    run.spread_frames += is_after_faults && spread > 0;
}

void scan(std::vector<StageFinding>& findings, const std::string& stage, const std::string& image,
          const HostImage& content) {
    auto finding =
        std::ranges::find_if(findings, [&](const StageFinding& f) { return f.stage == stage && f.image == image; });
    if (finding == findings.end()) finding = findings.insert(findings.end(), {.stage = stage, .image = image});
    for (const float value : content.values) {
        finding->nan += std::isnan(value), finding->infinite += std::isinf(value);
        if (std::isfinite(value)) finding->largest = std::max(finding->largest, double(std::abs(value)));
    }
}

/// zero_products(), which takes some ms, once for each pipeline. None of a shader whose products cannot be counted.
std::optional<unsigned> known_zero_products(const PipelineRecipe& recipe) {
    static std::mutex mutex;
    static std::map<std::string, std::optional<unsigned>> known;
    const std::string key = bytes_of({recipe});
    {
        const std::lock_guard lock(mutex);
        if (const auto found = known.find(key); found != known.end()) return found->second;
    }
    std::optional<unsigned> products;
    try {
        products = zero_products(recipe);
    } catch (const Error&) {  // the technique runs all the same
    }
    const std::lock_guard lock(mutex);
    return known[key] = products;
}

/// Sees the shaders of the passes, which run unchanged.
class ZeroProductWatcher : public PassWatcher {
public:
    explicit ZeroProductWatcher(ZeroProductCounts& found) : found_(found) {}
    std::optional<InstrumentedPipeline> before(const PassRun& run) override {
        const std::optional<unsigned> products = known_zero_products(run.recipe);
        if (products == 0u) return {};
        const auto [at, is_new] = found_.try_emplace(run.stage, products);
        // Several pipelines may share a stage: its largest count, or that one cannot be counted.
        if (!is_new)
            at->second = at->second && products ? std::optional(std::max(*at->second, *products)) : std::nullopt;
        return {};
    }

private:
    ZeroProductCounts& found_;
};

/// `findings`: of every image that the passes write; null: they are not looked at.
FrameImages render(const Renderer& technique, const CaseFrame& frame, unsigned seed,
                   std::vector<StageFinding>* findings, double& milliseconds) {
    PassList& pass_list = *technique.pass_list;
    if (findings)
        pass_list.observe([&pass_list, findings](const std::string& stage, std::span<const Image> written) {
            for (const Image& image : written) scan(*findings, stage, image.name, pass_list.download(image));
        });
    const Reflections reflections = technique.render(frame.camera, seed, frame.gbuffer);
    milliseconds = pass_list.frame_milliseconds();
    pass_list.observe({});  // what the compositor makes of a bad pixel is no stage of the technique
    const Composite composite = technique.compositor->render(frame.gbuffer, reflections);
    return {.specular = channels_of(pass_list.download(composite.specular), 0, 3),
            .radiance = channels_of(pass_list.download(reflections.radiance), 0, 3),
            .confidence = channels_of(pass_list.download(reflections.confidence), reflections.confidence_channel, 1)};
}

double mean_of_judged(const CaseFrames& frames, const HostImage& specular) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < specular.pixel_count(); ++i)
        if (const glm::vec3 c = specular.rgb(i); frames.is_judged[i] && is_finite(c))
            sum += double(c.x + c.y + c.z) / 3, ++count;
    return count ? sum / double(count) : 0.0;
}

void render_all(CaseResult& run, const Renderer& technique, const CaseFrames& frames, const StabilityCase& what,
                const CaseOptions& options) {
    const glm::uvec2 extent = technique.pass_list->extent();
    unsigned last_fault = 0;
    for (const InputFault& fault : what.faults) last_fault = std::max(last_fault, fault.step.value_or(1u << 31));
    HostImage fed_back;
    for (size_t step = 0; step < frames.steps.size(); ++step) {
        CaseFrame frame = frames.steps[step];
        std::optional<PassList> mirror;
        if (!fed_back.values.empty()) {
            mirror.emplace(technique.pass_list->device(), extent);
            HostImage rgba(extent, 4, 1.0f);
            for (size_t i = 0; i < rgba.pixel_count(); ++i) rgba.set_rgb(i, fed_back.rgb(i));
            frame.gbuffer.lit = mirror->image("lit", Format::rgba32f);
            mirror->upload(frame.gbuffer.lit, rgba);
        }
        double milliseconds = 0;
        // Of long sequences some frames are enough.
        const bool is_looked_at = options.is_scanned && (step < 32 || step % 16 == 0);
        ZeroProductWatcher watcher(run.zero_products);
        technique.pass_list->watch(options.is_scanned && step == 0 ? &watcher : nullptr);
        FrameImages images = render(technique, frame, options.seed, is_looked_at ? &run.stages : nullptr, milliseconds);
        technique.pass_list->watch(nullptr);
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
    for (const StageFinding& f : run.stages) {
        if (f.nan + f.infinite == 0) continue;
        if (run.non_finite == 0) run.first_non_finite = f.stage + ": " + f.image;
        run.non_finite += f.nan + f.infinite;
    }
}

}  // namespace

bool is_finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

CaseResult run_case(Device& device, const PointConfig& point, const StabilityCase& what, const CaseFrames& frames,
                    const CaseOptions& options, const CaseFrames* before) {
    CaseResult run;
    try {
        Renderer technique(device, (before ? before : &frames)->shot->config.extent, point);
        if (before) {
            CaseResult smaller;
            render_all(smaller, technique, *before, what, {});
            technique.pass_list = std::make_unique<PassList>(device, frames.shot->config.extent);
            technique.compositor = std::make_unique<Compositor>(*technique.pass_list);
        }
        render_all(run, technique, frames, what, options);
    } catch (const Error& error) {
        run.refusal = error.what();
    }
    return run;
}

std::optional<double> relative_difference(const CaseFrames& frames, const HostImage& a, const HostImage& b) {
    if (frames.truth.values.empty()) return std::nullopt;
    double squares = 0, truth = 0;
    for (size_t i = 0; i < a.pixel_count(); ++i) {
        if (!frames.is_judged[i] || !is_finite(a.rgb(i)) || !is_finite(b.rgb(i))) continue;
        const glm::dvec3 t(frames.truth.rgb(i)), difference = glm::dvec3(a.rgb(i)) - glm::dvec3(b.rgb(i));
        squares += glm::dot(difference, difference), truth += glm::dot(t, t);
    }
    if (truth == 0) return std::nullopt;
    return squares / truth;
}
