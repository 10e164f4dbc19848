#include "experiments/study/measuring/rays/error_causes.h"

#include "metrics/noise.h"
#include "metrics/statistics/estimates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

double sum(const VerdictSums& sums) { return std::accumulate(sums.begin(), sums.end(), 0.0); }

}  // namespace

void ErrorCauses::add(const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent) {
    const size_t pixels = size_t(extent.x) * extent.y;
    of_pixel_.resize(pixels);
    std::vector<VerdictSums> of_pass(pixels);
    for (size_t i = 0; i < recorded.rays.size(); ++i) {
        const RayRecord& ray = recorded.rays[i];
        const size_t pixel = i / recorded.rays_per_pixel;
        if (ray.is_traced > 0 && pixel < pixels) add_verdicts(of_pass[pixel], ray, truth[i]);
    }
    for (size_t pixel = 0; pixel < pixels; ++pixel)
        if (sum(of_pass[pixel]) > 0) of_pixel_[pixel] = of_pass[pixel];
}

size_t ErrorCauses::pixel_with_rays(size_t pixel, glm::uvec2 extent) const {
    if (sum(of_pixel_[pixel]) > 0) return pixel;
    const size_t left = pixel % extent.x & ~size_t(1), top = pixel / extent.x & ~size_t(1);
    for (size_t y = top; y < std::min<size_t>(top + 2, extent.y); ++y)
        for (size_t x = left; x < std::min<size_t>(left + 2, extent.x); ++x)
            if (sum(of_pixel_[y * extent.x + x]) > 0) return y * extent.x + x;
    return pixel;
}

void ErrorCauses::finish(const MetricReference& reference, const HostImage& tested, const std::vector<Mask>& masks) {
    // As every mean squared error is measured, (x - A)(x - B); without halves both are the image.
    const HostImage &a = reference.halves ? reference.halves->a : reference.image,
                    &b = reference.halves ? reference.halves->b : reference.image;
    const Plane squared_errors = cross_error(tested, a, b, a, metric_named("mse").squared_error_weight);
    of_pixel_.resize(tested.pixel_count());
    for (const Mask& mask : masks) {
        const Mask inside = intersection(mask, reference.finite);
        Shares errors{};
        size_t count = 0;
        for (size_t pixel = 0; pixel < tested.pixel_count(); ++pixel) {
            const double error = squared_errors.values[pixel];
            if (!inside.inside[pixel] || !std::isfinite(error)) continue;
            ++count;
            const VerdictSums& rays = of_pixel_[pixel_with_rays(pixel, tested.extent)];
            const double all = sum(rays);
            if (all == 0) errors.back() += error;
            for (size_t verdict = 0; all > 0 && verdict < ray_verdict_count; ++verdict)
                errors[verdict] += error * rays[verdict] / all;
        }
        const double whole = std::accumulate(errors.begin(), errors.end(), 0.0);
        if (!(whole > 0)) continue;
        for (double& error : errors) error /= whole;
        auto entry = std::ranges::find(by_mask_, mask.name, &decltype(by_mask_)::value_type::first);
        if (entry == by_mask_.end()) entry = by_mask_.insert(by_mask_.end(), {mask.name, {}});
        entry->second.push_back({count, errors});
    }
    of_pixel_.clear();
}

std::vector<HitRow> ErrorCauses::rows(const HitRow& shared) const {
    std::vector<HitRow> rows;
    for (const auto& [mask, seeds] : by_mask_)
        for (size_t cause = 0; cause < cause_count; ++cause) {
            std::vector<double> values;
            double pixels = 0;
            for (const SeedShares& seed : seeds) values.push_back(seed.shares[cause]), pixels += double(seed.pixels);
            HitRow row = shared;
            row.stage = error_stage, row.mask = mask, row.seeds = unsigned(seeds.size());
            row.quantity =
                std::string("error: ") + (cause < ray_verdict_count ? ray_verdict_names()[cause] : "untraced");
            row.rays = pixels / double(seeds.size());
            row.value = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
            if (values.size() > 1) {
                const Estimate estimate = mean_estimate(values);
                row.low = estimate.low, row.high = estimate.high;
            }
            rows.push_back(std::move(row));
        }
    return rows;
}
