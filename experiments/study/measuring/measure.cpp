#include "experiments/study/measuring/measure.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/composite.h"
#include "groundtruth/reference/truth_ladder.h"

#include <cmath>
#include <span>
#include <tuple>

namespace {

std::optional<double> if_finite(std::optional<double> value) {
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string content_hash(const Reference& reference) {
    ContentHash hash;
    for (const ReferenceOutput* output :
         {&reference.image, &reference.diffuse, &reference.specular, &reference.incident})
        for (const HostImage* image : {&output->mean, &output->half_a, &output->half_b})
            hash.add(std::as_bytes(std::span(image->values)));
    if (!reference.ladder.is_empty())
        for (const ReferenceOutput* output : {&reference.ladder.camera_radiance, &reference.ladder.on_screen})
            for (const HostImage* image : {&output->half_a, &output->half_b})
                hash.add(std::as_bytes(std::span(image->values)));
    for (const HostImage* image : {&reference.highlights, &reference.depth, &reference.normal, &reference.material_id,
                                   &reference.guide.specular, &reference.guide.incident, &reference.guide.diffuse})
        hash.add(std::as_bytes(std::span(image->values)));
    return hash.hex();
}

/// More than half of a frame may be black; the exposure it is displayed with is then the only sensible one.
FlipExposures exposures_of(const Reference& reference, const MetricSettings& settings) {
    try {
        if (!reference.is_lit_only()) return flip_exposure_range(reference.image.mean, settings.hdr_flip_tone_map);
    } catch (const Error&) {
    }
    return {.start = settings.exposure_ev, .stop = settings.exposure_ev, .count = 1};
}

const ReferenceOutput& target_output(const std::string& target, const Reference& reference) {
    if (target == "incident") return reference.incident;
    if (!is_ladder_rung(target)) return reference.specular;
    if (reference.ladder.is_empty())
        fail("the target '", target,
             "' needs a reference with a truth ladder, and this one has none; `ssrlab reference ",
             "--ladder` renders one");
    return target == "on_screen" ? reference.ladder.on_screen : reference.ladder.camera_radiance;
}

/// The least count of samples of a pixel that reflects or not, but is no background.
double least_samples(const Reference& reference) {
    double least = 0;
    for (size_t i = 0; i < reference.material_id.values.size(); ++i)
        if (reference.material_id.values[i] != 0 && (least == 0 || reference.sample_count.values[i] < least))
            least = reference.sample_count.values[i];
    return least;
}

ReferenceHalves halves_of(const ReferenceOutput& output, const HostImage& guide, const Reference& reference) {
    return {.a = output.half_a,
            .b = output.half_b,
            .variance = output.variance,
            .guide = guide,
            .samples = least_samples(reference)};
}

PoseTruth::Rung rung_halves(const std::string& rung, const Reference& reference) {
    const ReferenceOutput& incident = target_output(rung, reference);
    const TruthLadder::ErrorVariance& error =
        rung == "on_screen" ? reference.ladder.on_screen_error : reference.ladder.camera_radiance_error;
    PoseTruth::Rung halves{rung, halves_of(incident, reference.guide.incident, reference),
                           halves_of(reflected(reference, incident), reference.guide.specular, reference)};
    halves.incident.variance = error.incident, halves.specular.variance = error.specular;
    return halves;
}

MetricReference target_reference(const std::string& target, const Reference& reference,
                                 const std::vector<std::string>& metrics, const MetricSettings& settings) {
    const ReferenceOutput& output = target_output(target, reference);
    const ReferenceGuide& guide = reference.guide;
    HostImage mean = output.mean;
    ReferenceHalves halves =
        halves_of(output, &output == &reference.specular ? guide.specular : guide.incident, reference);
    if (target == "image") {
        // A result's `image` adds the truth's own direct light, so the noise in it is that of the specular halves
        // alone.
        const HostImage direct = sum(reference.diffuse.mean, reference.highlights);
        mean = sum(direct, mean), halves.a = sum(direct, halves.a), halves.b = sum(direct, halves.b);
        halves.guide = sum(sum(guide.diffuse, reference.highlights), guide.specular);
    }
    return metric_reference(std::move(mean), std::move(halves), metrics, settings);
}

/// Of a mask's pixels, those that a result may leave undefined: were it more, the others would stand for them, and a
/// technique that fails where it errs most would seem the best. Where it errs ten times as much as elsewhere, a
/// hundredth hides a tenth of the error.
constexpr double most_undefined = 0.01;

/// Per mask, how many finite pixels an error under it needs.
std::vector<size_t> needed_pixels(std::span<const Mask> masks, const MetricReference& reference) {
    std::vector<size_t> needed;
    for (const Mask& mask : masks)
        needed.push_back(
            size_t(std::ceil((1 - most_undefined) * double(intersection(mask, reference.finite).count()))));
    return needed;
}

/// One row per score. A mask that holds no pixel of this scene gives none; one of whose pixels too many are not finite
/// gives a row without a value.
void add_rows(std::vector<ResultRow>& rows, const MetricReference& reference, const std::string& target,
              const HostImage& test, std::span<const Mask> masks, const ResultRow& shared,
              std::vector<NoisyMap>* noise = nullptr) {
    PixelCounts counts;
    std::vector<NoisyMap> terms;
    std::vector<Score> scores = score(reference, test, masks, &counts, noise ? &terms : nullptr);
    const std::vector<size_t> needed = needed_pixels(masks, reference);
    for (size_t i = 0; i < scores.size(); ++i) {
        Score& s = scores[i];
        if (masks[i % masks.size()].count() == 0) continue;
        ResultRow r = shared;
        r.target = target, r.metric = s.metric->name, r.formula = s.formula, r.mask = s.mask;
        r.corrected = s.corrected, r.floor = if_finite(s.floor);
        if (s.pixels >= needed[i % masks.size()]) {
            r.value = if_finite(s.value), r.uncorrected = if_finite(s.uncorrected);
            r.low = if_finite(s.low), r.high = if_finite(s.high);
        }
        r.growth = std::move(s.growth), r.pixels = s.pixels, r.non_finite = counts.non_finite(),
        r.negative = counts.negative;
        rows.push_back(std::move(r));
        if (noise) noise->push_back(std::move(terms[i]));
    }
}

bool depends_on_result(const std::string& mask) { return mask == "hit" || mask == "miss"; }

float depth_step(DepthFormat format) {
    return format == DepthFormat::d16 ? std::exp2(-16.0f) : format == DepthFormat::d24 ? std::exp2(-24.0f) : 0.0f;
}

MaskInputs mask_inputs(const FrameTruth& truth, const HostImage& confidence, const Config& config,
                       const PreviousFrame* previous) {
    return {.view_depth = truth.pose->view_depth,
            .normal = truth.pose->normal,
            .material_id = truth.pose->material_id,
            .roughness = truth.roughness,
            .reflectance = truth.reflectance,
            .confidence = confidence,
            .reflective_max_roughness = config.reflective_max_roughness,
            .reflective_min_reflectance = config.reflective_min_reflectance,
            .previous = previous};
}

}  // namespace

HostImage sum(const HostImage& a, const HostImage& b) {
    HostImage total = a;
    for (size_t i = 0; i < total.values.size(); ++i) total.values[i] += b.values[i];
    return total;
}

PoseTruth pose_truth(const Reference& reference, const Config& config, float exposure_ev, PoseUse use) {
    PoseTruth truth{.diffuse = reference.diffuse.mean,
                    .lit_halves = ReferenceHalves{.a = reference.diffuse.half_a, .b = reference.diffuse.half_b},
                    .direct = sum(reference.diffuse.mean, reference.highlights),
                    .targets = {},
                    .rungs = {},
                    .view_depth = reference.depth,
                    .normal = reference.normal,
                    .material_id = reference.material_id,
                    .flip_exposures = {},
                    .content_hash = content_hash(reference)};
    MetricSettings settings{.exposure_ev = exposure_ev};
    truth.flip_exposures = exposures_of(reference, settings);
    settings.flip_exposures = truth.flip_exposures;
    if (use.has_targets)
        for (const std::string& target : config.targets) {
            truth.targets.emplace(target, target_reference(target, reference, config.metrics, settings));
            if (is_ladder_rung(target)) truth.rungs.push_back(rung_halves(target, reference));
        }
    if (use.has_frame_reference)
        truth.frame_reference = target_reference("specular", reference, config.frame_metrics, settings);
    return truth;
}

FrameTruth frame_truth(std::shared_ptr<const PoseTruth> pose, const HostGBuffer& gbuffer, const Config& config) {
    FrameTruth truth{.pose = std::move(pose),
                     .roughness = channels_of(gbuffer.normal, 3, 1),
                     .reflectance = specular_reflectance(gbuffer),
                     .emission = channels_of(gbuffer.emission, 0, 3),
                     .masks = {}};
    const PreviousFrame previous{.camera = gbuffer.camera,
                                 .motion = gbuffer.motion,
                                 .depth = gbuffer.previous_depth,
                                 .normal = gbuffer.previous_normal,
                                 .depth_step = depth_step(gbuffer.depth_format)};
    const HostImage no_confidence(gbuffer.extent(), 1);
    for (const std::string& name : config.masks)
        truth.masks.push_back(depends_on_result(name)
                                  ? Mask{.name = name, .inside = {}}
                                  : make_mask(name, mask_inputs(truth, no_confidence, config, &previous)));
    return truth;
}

std::vector<Mask> masks_of(const FrameTruth& truth, const HostImage& confidence, const Config& config) {
    std::vector<Mask> masks = truth.masks;
    if (confidence.values.empty()) std::erase_if(masks, [](const Mask& mask) { return depends_on_result(mask.name); });
    for (Mask& mask : masks)
        if (depends_on_result(mask.name)) mask = make_mask(mask.name, mask_inputs(truth, confidence, config, nullptr));
    return masks;
}

HostImage composited_image(const PoseTruth& truth, const CompositedImages& result) {
    return result.image.values.empty() ? sum(truth.direct, result.specular) : result.image;
}

const HostImage& tested_image(const std::string& target, const CompositedImages& result, const HostImage& image) {
    return target == "specular" ? result.specular : target == "image" ? image : result.incident;
}

std::vector<ResultRow> measure_targets(const PoseTruth& truth, const CompositedImages& result,
                                       std::span<const Mask> masks, const ResultRow& row) {
    const HostImage image = composited_image(truth, result);
    std::vector<ResultRow> rows;
    for (const auto& [target, reference] : truth.targets) {
        const HostImage& tested = tested_image(target, result, image);
        if (!tested.values.empty()) add_rows(rows, reference, target, tested, masks, row);
    }
    return rows;
}

FrameRows measure_frame(const PoseTruth& truth, const HostImage& specular, std::span<const Mask> masks,
                        const ResultRow& row) {
    FrameRows frame;
    add_rows(frame.rows, *truth.frame_reference, "specular", specular, masks, row, &frame.noise);
    return frame;
}
