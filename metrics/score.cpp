#include "metrics/score.h"

#include "core/error.h"
#include "metrics/noise.h"
#include "metrics/pooling.h"

#include <cmath>

namespace {

HostImage blackened(HostImage image, const Mask& kept) {
    for (size_t i = 0; i < image.pixel_count(); ++i)
        if (!kept.inside[i]) image.set_rgb(i, glm::vec3(0));
    return image;
}

/// Per pixel, the two things that the halves tell of a metric: its value without the reference's noise, and half its
/// change when the halves are swapped.
struct NoiseMaps {
    Plane corrected, swapped;
};

NoiseMaps squared_error_maps(const Metric& metric, const MetricReference& reference, const ReferenceHalves& halves,
                             const HostImage& test) {
    const auto weight = metric.squared_error_weight;
    NoiseMaps maps{cross_error(test, halves.a, halves.b, reference.smooth, weight), Plane(test.extent)};
    const Plane from_a = cross_error(test, halves.a, halves.a, reference.smooth, weight);
    const Plane from_b = cross_error(test, halves.b, halves.b, reference.smooth, weight);
    for (size_t i = 0; i < from_a.values.size(); ++i)
        maps.swapped.values[i] = (from_a.values[i] - from_b.values[i]) / 2;
    return maps;
}

/// The bias is linear in the reference: it needs no correction, but has an interval.
Plane swapped_bias(const ReferenceHalves& halves) {
    Plane map(halves.a.extent);
    for (size_t i = 0; i < map.values.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(halves.b.rgb(i)) - glm::dvec3(halves.a.rgb(i));
        map.values[i] = (d.x + d.y + d.z) / 3 / 2;
    }
    return map;
}

/// An error whose square is not above 0 after the correction is lost in the reference's noise: 0.
double root(double square) { return std::sqrt(square < 0 ? 0.0 : square); }

void correct(Score& score, const NoiseMaps& maps, const Mask& mask) {
    const double value = masked_mean(maps.corrected, mask), half_width = noise_half_width(maps.swapped, mask);
    const bool is_root = score.metric->name == "rmse";
    const auto finished = [&](double v) { return is_root ? root(v) : v; };
    score.value = finished(value);
    score.corrected = true;
    score.low = finished(value - half_width);
    score.high = finished(value + half_width);
}

}  // namespace

MetricReference metric_reference(HostImage image, std::optional<ReferenceHalves> halves,
                                 const std::vector<std::string>& metric_names, const MetricSettings& settings) {
    MetricReference reference{.image = std::move(image), .halves = std::move(halves), .settings = settings};
    for (const std::string& name : metric_names) reference.metrics.push_back(&metric_named(name));
    if (!reference.halves) {
        reference.finite = full_mask(reference.image.extent);
        return reference;
    }
    const ImagePair pair = image_pair(reference.halves->a, reference.halves->b, settings);
    reference.finite = intersection(pair.finite, image_pair(reference.image, pair.reference, settings).finite);
    *reference.halves = {blackened(reference.halves->a, reference.finite),
                         blackened(reference.halves->b, reference.finite)};
    for (const Metric* metric : reference.metrics) reference.floor_layers.push_back(metric->layers(pair));
    reference.smooth = without_noise(reference.halves->a, reference.halves->b);
    return reference;
}

std::vector<Score> score(const MetricReference& reference, const HostImage& test, std::span<const Mask> masks,
                         PixelCounts* counts) {
    const ImagePair pair = image_pair(reference.image, test, reference.settings);
    if (counts) *counts = pair.test_counts;
    const Mask finite = intersection(pair.finite, reference.finite);
    std::vector<Score> scores;
    for (size_t m = 0; m < reference.metrics.size(); ++m) {
        const Metric& metric = *reference.metrics[m];
        const std::vector<Plane> layers = metric.layers(pair);
        const bool is_correctable = reference.halves && metric.squared_error_weight;
        NoiseMaps maps;
        if (is_correctable) maps = squared_error_maps(metric, reference, *reference.halves, pair.test);
        if (reference.halves && metric.name == "bias") maps.swapped = swapped_bias(*reference.halves);

        for (const Mask& mask : masks) {
            const Mask inside = intersection(mask, finite);
            const double value = metric.pool(layers, inside);
            Score& row = scores.emplace_back(
                Score{.metric = &metric, .mask = mask.name, .value = value, .uncorrected = value, .corrected = false});
            row.pixels = inside.count();
            if (!reference.halves || row.pixels == 0) continue;
            row.floor = metric.pool(reference.floor_layers[m], inside);
            if (is_correctable) {
                correct(row, maps, inside);
            } else if (!maps.swapped.values.empty()) {
                const double half_width = noise_half_width(maps.swapped, inside);
                row.low = value - half_width;
                row.high = value + half_width;
            }
        }
    }
    return scores;
}
