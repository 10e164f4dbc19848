#include "metrics/statistics.h"

#include "core/error.h"
#include "metrics/pooling.h"
#include "metrics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

struct Moments {
    double mean, standard_error;
};

Moments moments(std::span<const double> values) {
    if (values.size() < 2) fail("a confidence interval needs at least two values, found ", values.size());
    const double n = double(values.size());
    const double mean = ordered_sum(values.size(), [&](size_t i) { return values[i]; }) / n;
    const double squares =
        ordered_sum(values.size(), [&](size_t i) { return (values[i] - mean) * (values[i] - mean); });
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

Estimate interval(const Moments& m, size_t count) {
    const double half_width = student_t_quantile(0.975, double(count - 1)) * m.standard_error;
    return {m.mean, m.mean - half_width, m.mean + half_width};
}

}  // namespace

Estimate mean_estimate(std::span<const double> values) { return interval(moments(values), values.size()); }

RatioEstimate paired_ratio(std::span<const double> a, std::span<const double> b) {
    if (a.size() != b.size())
        fail("a paired comparison needs as many values on each side, found ", a.size(), " and ", b.size());
    std::vector<double> logarithms;
    for (size_t i = 0; i < a.size(); ++i) {
        if (!(a[i] > 0 && b[i] > 0)) fail("a ratio of errors needs values above 0, found ", a[i], " and ", b[i]);
        logarithms.push_back(std::log(a[i] / b[i]));
    }
    const Moments m = moments(logarithms);
    const Estimate e = interval(m, logarithms.size());
    const double t = m.mean == 0 ? 0 : std::abs(m.mean) / m.standard_error;
    return {{std::exp(e.value), std::exp(e.low), std::exp(e.high)}, 2 * student_t_cdf(-t, double(a.size() - 1))};
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
    std::vector<size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return p_values[i]; });
    std::vector<double> adjusted(p_values.size());
    double greatest = 0;
    for (size_t rank = 0; rank < order.size(); ++rank) {
        greatest = std::max(greatest, double(order.size() - rank) * p_values[order[rank]]);
        adjusted[order[rank]] = std::min(1.0, greatest);
    }
    return adjusted;
}

void SeedMoments::add(const HostImage& rgb) {
    if (count == 0) {
        extent = rgb.extent;
        mean.assign(rgb.pixel_count() * 3, 0.0);
        squares = mean;
        finite = full_mask(extent);
    }
    if (rgb.extent != extent || rgb.channels != 3) fail("all seeds need images of one size and three channels");
    ++count;
    for (size_t i = 0; i < mean.size(); ++i) {
        const double before = rgb.values[i] - mean[i];
        mean[i] += before / count;
        squares[i] += before * (rgb.values[i] - mean[i]);
        if (!std::isfinite(rgb.values[i])) finite.inside[i / 3] = 0;
    }
}

ErrorSplit split_error(const SeedMoments& seeds, const HostImage& reference,
                       const std::optional<ReferenceHalves>& halves, const Mask& mask) {
    if (seeds.count < 2) fail("telling bias from variance needs at least two seeds, found ", seeds.count);
    const HostImage& a = halves ? halves->a : reference;
    const HostImage& b = halves ? halves->b : reference;
    if (a.extent != seeds.extent || b.extent != seeds.extent)
        fail("the reference and the seeds need images of one size");
    Mask inside = intersection(mask, seeds.finite);
    Plane bias_squared(seeds.extent), variance(seeds.extent);
    for (size_t i = 0; i < seeds.mean.size(); ++i) {
        if (!std::isfinite(a.values[i]) || !std::isfinite(b.values[i])) inside.inside[i / 3] = 0;
        if (!inside.inside[i / 3]) continue;
        const double v = seeds.variance(i);
        variance.values[i / 3] += v / 3;
        bias_squared.values[i / 3] +=
            ((seeds.mean[i] - a.values[i]) * (seeds.mean[i] - b.values[i]) - v / seeds.count) / 3;
    }
    const double bias = masked_mean(bias_squared, inside), spread = masked_mean(variance, inside);
    return {bias + spread, bias, spread};
}
