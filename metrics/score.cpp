#include "metrics/score.h"

#include "core/error.h"
#include "metrics/pooling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace {

HostImage blackened(HostImage image, const Mask& kept) {
    for (size_t i = 0; i < image.pixel_count(); ++i)
        if (!kept.inside[i]) image.set_rgb(i, glm::vec3(0));
    return image;
}

bool is_guided(const Metric& metric) { return !metric.guided_formula.empty(); }

/// Empty if the noise gives the metric no interval, or one that is extrapolated.
NoisyMap noisy_terms(const Metric& metric, const ReferenceHalves& halves, const HostImage& test) {
    if (const auto weight = metric.squared_error_weight) return squared_error(test, halves, halves.guide, weight);
    if (metric.name == "bias" || metric.name == "energy_ratio") return mean_noise(halves);
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

void set_interval(Score& row, const std::optional<Interval>& found) {
    if (found) row.low = found->low, row.high = found->high;
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
NoisyMap scaled(const NoisyMap& terms, const Mask& inside, double slope, double pixels) {
    NoisyMap scaled = noisy_map(terms.swapped.extent, terms.samples);
    for (size_t i = 0; i < inside.inside.size(); ++i)
        if (inside.inside[i]) {
            scaled.swapped.values[i] = terms.swapped.values[i] * slope / pixels;
            scaled.variance.values[i] = terms.variance.values[i] * slope * slope / (pixels * pixels);
        }
    return scaled;
}

/// The test image against references of more noise, for metrics that are extrapolated: A and B, which have twice the
/// variance of the reference's noise, and R +- sqrt(3) (A - B) / 2, four times.
std::vector<ImagePair> noisier_pairs(const MetricReference& reference, const HostImage& test) {
    const ReferenceHalves& h = *reference.halves;
    std::vector<ImagePair> pairs;
    for (const HostImage* half : {&h.a, &h.b}) pairs.push_back(image_pair(*half, test, reference.settings));
    for (const double sign : {1.0, -1.0}) {
        HostImage moved = reference.image;
        for (size_t i = 0; i < moved.values.size(); ++i)
            moved.values[i] += float(sign * extrapolation_step * (double(h.a.values[i]) - h.b.values[i]) / 2);
        pairs.push_back(image_pair(blackened(std::move(moved), reference.finite), test, reference.settings));
    }
    return pairs;
}

/// Windows of SSIM weigh noise against the scene's own contrast: how its means grow says too little of what they would
/// be without (metrics/coverage.md: in a dark room no interval of SSIM held that). Of PU21 codes this was not measured.
constexpr std::string_view not_extrapolated[] = {"ssim", "psnr_pu21", "ssim_pu21"};

/// Means of absolute differences grow by neither law where rare bright paths make the noise: then they have no
/// interval.
constexpr std::string_view of_absolutes[] = {"mae", "smape"};

/// All others but means of squares, and differences and ratios of means.
bool is_extrapolated(const Metric& metric) {
    if (std::ranges::count(not_extrapolated, metric.name) > 0) return false;
    return metric.mean_map || (!metric.squared_error_weight && metric.pool == pooled_mean && metric.name != "bias");
}

/// The value stays what everyone computes from both images; the interval reaches to where it would lie without the
/// reference's noise. `noisier`: the metric's layers of noisier_pairs().
void set_extrapolated(Score& row, const std::vector<Plane>& own, std::span<const std::vector<Plane>> noisier,
                      const Mask& inside) {
    const Metric& metric = *row.metric;
    std::array<Plane, 5> made;
    std::array<const Plane*, 5> maps;
    for (size_t i = 0; i < maps.size(); ++i) {
        const std::vector<Plane>& layers = i == 0 ? own : noisier[i - 1];
        if (metric.mean_map) made[i] = metric.mean_map(layers, inside);
        maps[i] = metric.mean_map ? &made[i] : &layers.front();
    }
    row.growth = noise_growth(maps, inside);
    if (std::ranges::count(of_absolutes, metric.name) > 0 && !follows_a_law(row.growth)) row.growth.clear();
    const std::optional<Interval> found = extrapolated_interval(row.growth);
    row.low = row.high = std::nullopt;
    if (!found) return;
    row.low = found->low, row.high = found->high;
    if (metric.of_mean) {
        const double ends[] = {metric.of_mean(std::max(found->low, 0.0)), metric.of_mean(found->high)};
        row.low = std::min(ends[0], ends[1]), row.high = std::max(ends[0], ends[1]);
    }
    if (metric.better == Better::lower) row.low = std::max(*row.low, 0.0);
}

/// Corrects the row where it can be, and gives it its interval; returns how noise moves its value.
NoisyMap set_noise(Score& row, const NoisyMap& terms, std::span<const Plane> layers, const Mask& inside,
                   bool wants_terms) {
    if (terms.is_empty()) return {};
    std::optional<double> half_width = noise_half_width(terms, inside);
    if (half_width) *half_width /= double(row.pixels);
    Slope slope = 1.0;
    if (!terms.error.values.empty()) {
        slope = set_corrected(row, masked_mean(terms.error, inside), half_width);
    } else if (row.metric->name == "energy_ratio") {
        slope = set_ratio(row, masked_mean(layers[1], inside), half_width);
    } else if (half_width) {
        set_interval(row, row.value, *half_width, [](double v) { return v; });
    }
    if (!wants_terms || !slope) return {};
    return scaled(terms, inside, *slope, double(row.pixels));
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
                         PixelCounts* counts, std::vector<NoisyMap>* noise) {
    const ImagePair pair = image_pair(reference.image, test, reference.settings);
    if (counts) *counts = pair.test_counts;
    const Mask finite = intersection(pair.finite, reference.finite);
    std::vector<Score> scores;
    std::vector<ImagePair> noisier;
    for (size_t m = 0; m < reference.metrics.size(); ++m) {
        const Metric& metric = *reference.metrics[m];
        const std::vector<Plane> layers = layers_of(metric, pair, reference.halves);
        const NoisyMap terms = reference.halves ? noisy_terms(metric, *reference.halves, pair.test) : NoisyMap{};
        std::vector<std::vector<Plane>> extrapolated;
        if (reference.halves && (is_extrapolated(metric) || metric.noise_interval)) {
            if (noisier.empty()) noisier = noisier_pairs(reference, test);
            const size_t count = metric.noise_interval ? 2 : noisier.size();
            for (size_t i = 0; i < count; ++i) extrapolated.push_back(metric.layers(noisier[i]));
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
            NoisyMap of_value = has_noise ? set_noise(row, terms, layers, inside, noise != nullptr) : NoisyMap{};
            if (has_noise && metric.noise_interval && std::isfinite(value))
                set_interval(row, metric.noise_interval({layers, extrapolated[0], extrapolated[1]}, *reference.halves,
                                                        reference.settings));
            else if (has_noise && is_extrapolated(metric))
                set_extrapolated(row, layers, extrapolated, inside);
            if (noise) noise->push_back(std::move(of_value));
        }
    }
    return scores;
}
