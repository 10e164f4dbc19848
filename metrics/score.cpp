#include "metrics/score.h"

#include "core/error.h"
#include "metrics/pooling.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace {

HostImage blackened(HostImage image, const Mask& kept) {
    for (size_t i = 0; i < image.pixel_count(); ++i)
        if (!kept.inside[i]) image.set_rgb(i, glm::vec3(0));
    return image;
}

/// The estimates of the halves for a metric at each pixel.
struct NoiseMaps {
    Plane corrected;   ///< its value without the reference's noise; empty if it is not corrected
    NoiseTerms terms;  ///< empty if the metric has no interval
};

bool is_guided(const Metric& metric) { return !metric.guided_formula.empty(); }

NoiseMaps noise_maps(const Metric& metric, const ReferenceHalves& halves, const HostImage& test) {
    if (const auto weight = metric.squared_error_weight)
        return {cross_error(test, halves.a, halves.b, halves.guide, weight),
                squared_error_noise(test, halves, halves.guide, weight)};
    if (metric.name == "bias" || metric.name == "energy_ratio") return {{}, mean_noise(halves)};
    return {};
}

std::vector<Plane> layers_of(const Metric& metric, const ImagePair& pair,
                             const std::optional<ReferenceHalves>& halves) {
    if (!halves || !is_guided(metric)) return metric.layers(pair);
    return {cross_error(pair.test, pair.reference, pair.reference, halves->guide, metric.squared_error_weight)};
}

/// From raw +- half_width by `finish`, which is monotonic between the two.
template <class Finish>
void set_interval(Score& row, double raw, double half_width, const Finish& finish) {
    const double ends[2] = {finish(raw - half_width), finish(raw + half_width)};
    row.low = std::min(ends[0], ends[1]);
    row.high = std::max(ends[0], ends[1]);
}

/// d(value) / d(raw) if the row has a value that moves in proportion, as far as its noise goes; else nothing.
using Slope = std::optional<double>;

Slope set_corrected(Score& row, double raw, std::optional<double> half_width) {
    row.value = raw;
    row.corrected = true;
    if (half_width) row.low = raw - *half_width, row.high = raw + *half_width;
    return 1.0;
}

/// The mean of the test image is fixed, so the interval is exact where that of the reference's mean is.
Slope set_ratio(Score& row, double reference_mean, std::optional<double> half_width) {
    const double test_mean = row.value * reference_mean;
    if (!half_width || !(std::abs(reference_mean) > *half_width)) return {};
    set_interval(row, reference_mean, *half_width, [&](double mean) { return test_mean / mean; });
    return test_mean / (reference_mean * reference_mean);
}

/// The terms of the mean over `inside`, times the slope.
NoiseTerms scaled(const NoiseTerms& terms, const Mask& inside, double slope, double pixels) {
    NoiseTerms scaled(terms.swapped.extent, terms.samples);
    for (size_t i = 0; i < inside.inside.size(); ++i)
        if (inside.inside[i]) {
            scaled.swapped.values[i] = terms.swapped.values[i] * slope / pixels;
            scaled.variance.values[i] = terms.variance.values[i] * slope * slope / (pixels * pixels);
        }
    return scaled;
}

/// The test image against references of more noise, for metrics that are extrapolated.
struct NoisierPairs {
    std::vector<ImagePair> halves;    ///< against A and B: twice the variance of the reference's noise
    std::vector<ImagePair> moved_on;  ///< against R +- sqrt(3) (A - B) / 2: four times
};

NoisierPairs noisier_pairs(const MetricReference& reference, const HostImage& test) {
    const ReferenceHalves& h = *reference.halves;
    NoisierPairs pairs;
    for (const HostImage* half : {&h.a, &h.b}) pairs.halves.push_back(image_pair(*half, test, reference.settings));
    for (const double sign : {1.0, -1.0}) {
        HostImage moved = reference.image;
        for (size_t i = 0; i < moved.values.size(); ++i)
            moved.values[i] += float(sign * extrapolation_step * (double(h.a.values[i]) - h.b.values[i]) / 2);
        pairs.moved_on.push_back(image_pair(blackened(std::move(moved), reference.finite), test, reference.settings));
    }
    return pairs;
}

/// Windows of SSIM weigh noise against the scene's own contrast: how its means grow says too little of what they would
/// be without (metrics/README.md: in a dark room no interval of SSIM held that).
constexpr std::string_view not_extrapolated[] = {"ssim"};

/// Means of absolute differences grow by neither law where rare bright paths make the noise: then they have no
/// interval.
constexpr std::string_view of_absolutes[] = {"mae", "smape"};

/// All others but means of squares, and differences and ratios of means.
bool is_extrapolated(const Metric& metric) {
    if (std::ranges::count(not_extrapolated, metric.name) > 0) return false;
    return metric.mean_map || (!metric.squared_error_weight && metric.pool == pooled_mean && metric.name != "bias");
}

/// Layers of one metric against references of more noise.
struct NoisierLayers {
    std::vector<std::vector<Plane>> halves, moved_on;
};

NoisierLayers noisier_layers(const Metric& metric, const NoisierPairs& pairs) {
    NoisierLayers layers;
    for (const ImagePair& pair : pairs.halves) layers.halves.push_back(metric.layers(pair));
    for (const ImagePair& pair : pairs.moved_on) layers.moved_on.push_back(metric.layers(pair));
    return layers;
}

/// The value stays what everyone computes from both images; the interval reaches to where it would lie without the
/// reference's noise.
void set_extrapolated(Score& row, const std::vector<Plane>& own, const NoisierLayers& noisier, const Mask& inside) {
    const Metric& metric = *row.metric;
    std::vector<Plane> made;
    made.reserve(5);
    const auto map = [&](const std::vector<Plane>& layers) -> const Plane& {
        return metric.mean_map ? made.emplace_back(metric.mean_map(layers, inside)) : layers.front();
    };
    row.growth = noise_growth(
        {map(own), map(noisier.halves[0]), map(noisier.halves[1]), map(noisier.moved_on[0]), map(noisier.moved_on[1])},
        inside);
    if (std::ranges::count(of_absolutes, metric.name) > 0 && !follows_a_law(row.growth)) row.growth.clear();
    const MapInterval found = extrapolated_interval(row.growth);
    row.low = found.low, row.high = found.high;
    if (!found.low) return;
    if (metric.of_mean) {
        const double ends[] = {metric.of_mean(std::max(*found.low, 0.0)), metric.of_mean(*found.high)};
        row.low = std::min(ends[0], ends[1]), row.high = std::max(ends[0], ends[1]);
    }
    if (metric.better == Better::lower) row.low = std::max(*row.low, 0.0);
}

/// Corrects the row where it can be, and gives it its interval; returns how noise moves its value.
NoiseTerms set_noise(Score& row, const NoiseMaps& maps, std::span<const Plane> layers, const Mask& inside,
                     bool wants_terms) {
    if (maps.terms.is_empty()) return {};
    std::optional<double> half_width = noise_half_width(maps.terms, inside);
    if (half_width) *half_width /= double(row.pixels);
    Slope slope = 1.0;
    if (!maps.corrected.values.empty()) {
        slope = set_corrected(row, masked_mean(maps.corrected, inside), half_width);
    } else if (row.metric->name == "energy_ratio") {
        slope = set_ratio(row, masked_mean(layers[1], inside), half_width);
    } else if (half_width) {
        set_interval(row, row.value, *half_width, [](double v) { return v; });
    }
    if (!wants_terms || !slope) return {};
    return scaled(maps.terms, inside, *slope, double(row.pixels));
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
    ReferenceHalves& h = *reference.halves;
    const ImagePair pair = image_pair(h.a, h.b, settings);
    reference.finite = pair.finite;
    for (const HostImage* other : {&reference.image, &h.variance, &h.guide})
        reference.finite = intersection(reference.finite, image_pair(*other, pair.reference, settings).finite);
    for (HostImage* each : {&h.a, &h.b, &h.variance, &h.guide}) *each = blackened(std::move(*each), reference.finite);
    for (const Metric* metric : reference.metrics)
        reference.floor_layers.push_back(layers_of(*metric, pair, reference.halves));
    return reference;
}

std::vector<Score> score(const MetricReference& reference, const HostImage& test, std::span<const Mask> masks,
                         PixelCounts* counts, std::vector<NoiseTerms>* noise) {
    const ImagePair pair = image_pair(reference.image, test, reference.settings);
    if (counts) *counts = pair.test_counts;
    const Mask finite = intersection(pair.finite, reference.finite);
    std::vector<Score> scores;
    std::optional<NoisierPairs> noisier;
    for (size_t m = 0; m < reference.metrics.size(); ++m) {
        const Metric& metric = *reference.metrics[m];
        const std::vector<Plane> layers = layers_of(metric, pair, reference.halves);
        const NoiseMaps maps = reference.halves ? noise_maps(metric, *reference.halves, pair.test) : NoiseMaps{};
        std::optional<NoisierLayers> extrapolated;
        if (reference.halves && is_extrapolated(metric)) {
            if (!noisier) noisier = noisier_pairs(reference, test);
            extrapolated = noisier_layers(metric, *noisier);
        }
        for (const Mask& mask : masks) {
            const Mask inside = intersection(mask, finite);
            const double value = metric.pool(layers, inside);
            Score& row = scores.emplace_back(
                Score{.metric = &metric,
                      .formula = reference.halves && is_guided(metric) ? metric.guided_formula : metric.formula,
                      .mask = mask.name,
                      .value = value,
                      .uncorrected = value,
                      .corrected = false});
            row.pixels = inside.count();
            const bool has_noise = reference.halves && row.pixels > 0;
            if (has_noise) row.floor = metric.pool(reference.floor_layers[m], inside);
            NoiseTerms terms = has_noise ? set_noise(row, maps, layers, inside, noise != nullptr) : NoiseTerms{};
            if (has_noise && extrapolated) set_extrapolated(row, layers, *extrapolated, inside);
            if (noise) noise->push_back(std::move(terms));
        }
    }
    return scores;
}
