#include "experiments/measure.h"

#include "core/error.h"

#include <cmath>

namespace {

HostImage sum(const HostImage& a, const HostImage& b) {
    HostImage total = a;
    for (size_t i = 0; i < total.values.size(); ++i) total.values[i] += b.values[i];
    return total;
}

std::optional<double> if_finite(std::optional<double> value) { return value && std::isfinite(*value) ? value : std::nullopt; }

const HostImage& tested_image(const std::string& target, const CompositedImages& result, const HostImage& image) {
    return target == "specular" ? result.specular : target == "incident" ? result.incident : image;
}

}  // namespace

FrameTruth frame_truth(const Reference& reference, HostImage roughness, HostImage reflectance, const Config& config, float exposure_ev) {
    FrameTruth truth{.diffuse = reference.diffuse.mean,
                     .targets = {},
                     .view_depth = reference.depth,
                     .normal = reference.normal,
                     .material_id = reference.material_id,
                     .roughness = std::move(roughness),
                     .reflectance = std::move(reflectance),
                     .flip_exposures = {}};
    MetricSettings settings{.exposure_ev = exposure_ev};
    try {
        truth.flip_exposures = flip_exposure_range(reference.image.mean, settings.hdr_flip_tone_map);
        truth.has_flip_exposures = true;
    } catch (const Error&) {
        // More than half of the frame is black; the exposure it is displayed with is then the only sensible one.
        truth.flip_exposures = {.start = exposure_ev, .stop = exposure_ev, .count = 1};
    }
    settings.flip_exposures = truth.flip_exposures;

    for (const std::string& target : config.targets) {
        // A result's `image` adds the truth's own diffuse light, so the noise in it is that of the specular halves alone.
        const ReferenceOutput& output = target == "incident" ? reference.incident : reference.specular;
        HostImage mean = output.mean;
        ReferenceHalves halves{output.half_a, output.half_b};
        if (target == "image") mean = sum(truth.diffuse, mean), halves = {sum(truth.diffuse, halves.a), sum(truth.diffuse, halves.b)};
        truth.targets.emplace(target, metric_reference(std::move(mean), std::move(halves), config.metrics, settings));
    }
    return truth;
}

FrameTruth frame_without_truth(HostImage lit) { return {.diffuse = std::move(lit), .targets = {}, .view_depth = {}, .normal = {}, .material_id = {}, .roughness = {}, .reflectance = {}, .flip_exposures = {}}; }

HostImage composited_image(const FrameTruth& truth, const CompositedImages& result) { return sum(truth.diffuse, result.specular); }

std::vector<ResultRow> measure_result(const FrameTruth& truth, const CompositedImages& result, const Config& config, const ResultRow& row) {
    if (truth.targets.empty()) return {};
    const MaskInputs inputs{.view_depth = truth.view_depth,
                            .normal = truth.normal,
                            .material_id = truth.material_id,
                            .roughness = truth.roughness,
                            .reflectance = truth.reflectance,
                            .confidence = result.confidence,
                            .reflective_max_roughness = config.reflective_max_roughness,
                            .reflective_min_reflectance = config.reflective_min_reflectance};
    std::vector<Mask> masks;
    for (const std::string& name : config.masks) masks.push_back(make_mask(name, inputs));

    const HostImage image = composited_image(truth, result);
    std::vector<ResultRow> rows;
    for (const auto& [target, reference] : truth.targets) {
        PixelCounts counts;
        for (const Score& s : score(reference, tested_image(target, result, image), masks, &counts)) {
            if (s.pixels == 0) continue;  // nothing of this scene lies under the mask
            ResultRow r = row;
            r.target = target, r.metric = s.metric->name, r.formula = s.metric->formula, r.mask = s.mask;
            r.value = if_finite(s.value), r.is_corrected = s.corrected, r.uncorrected = if_finite(s.uncorrected);
            r.low = if_finite(s.low), r.high = if_finite(s.high), r.floor = if_finite(s.floor);
            r.pixels = s.pixels, r.non_finite = counts.non_finite(), r.negative = counts.negative;
            rows.push_back(std::move(r));
        }
    }
    return rows;
}
