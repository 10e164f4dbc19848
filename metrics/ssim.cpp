#include "metrics/ssim.h"

#include "core/error.h"
#include "metrics/pooling.h"

#include <algorithm>
#include <array>
#include <cmath>

// SSIM: Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", with its Gaussian window, biased covariance, and only windows that lie within the image, as the authors'
// program has them.

namespace {

constexpr int radius = 5;
constexpr unsigned window = 2 * radius + 1;
constexpr double k1 = 0.01, k2 = 0.03;

const std::array<double, window>& taps() {
    static const auto values = [] {
        std::array<double, window> w;
        double sum = 0;
        for (int k = -radius; k <= radius; ++k) sum += w[k + radius] = std::exp(-k * k / (2 * 1.5 * 1.5));
        for (double& v : w) v /= sum;
        return w;
    }();
    return values;
}

/// The windowed mean where the window fits; elsewhere 0. Rows first, then columns.
Plane windowed(const Plane& in) {
    const auto& w = taps();
    Plane rows(in.extent), out(in.extent);
    out.margin = radius;
    tbb::parallel_for(0u, in.extent.y, [&](unsigned y) {
        double* to = rows.row(y);
        for (unsigned k = 0; k < window; ++k) {
            const double* from = in.row(y) + k;
            for (unsigned x = 0; x < in.extent.x - 2 * radius; ++x) to[x + radius] += w[k] * from[x];
        }
    });
    tbb::parallel_for(unsigned(radius), in.extent.y - radius, [&](unsigned y) {
        double* to = out.row(y);
        for (unsigned k = 0; k < window; ++k) {
            const double* from = rows.row(y + k - radius);
            for (unsigned x = 0; x < in.extent.x; ++x) to[x] += w[k] * from[x];
        }
    });
    return out;
}

Plane product(const Plane& a, const Plane& b) {
    Plane out(a.extent);
    for (size_t i = 0; i < out.values.size(); ++i) out.values[i] = a.values[i] * b.values[i];
    return out;
}

/// (2 mu_x mu_y + C1) / (mu_x^2 + mu_y^2 + C1) times (2 s_xy + C2) / (s_xx + s_yy + C2), with C = (K range)^2.
Plane similarity(const Plane& x, const Plane& y, double range) {
    const double c1 = k1 * range * (k1 * range), c2 = k2 * range * (k2 * range);
    if (x.extent.x < window || x.extent.y < window)
        fail("ssim needs images of at least ", window, "x", window, " pixels, but these have ", x.extent.x, "x",
             x.extent.y);
    const Plane mean_x = windowed(x), mean_y = windowed(y);
    const Plane xx = windowed(product(x, x)), yy = windowed(product(y, y)), xy = windowed(product(x, y));
    Plane s(x.extent);
    s.margin = radius;
    for (size_t i = 0; i < x.values.size(); ++i) {
        const double mx = mean_x.values[i], my = mean_y.values[i];
        const double s_xx = xx.values[i] - mx * mx, s_yy = yy.values[i] - my * my, s_xy = xy.values[i] - mx * my;
        s.values[i] = (2 * mx * my + c1) / (mx * mx + my * my + c1) * ((2 * s_xy + c2) / (s_xx + s_yy + c2));
    }
    return s;
}

Plane channel(const HostImage& image, int c) {
    Plane plane(image.extent);
    for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = image.values[i * 3 + c];
    return plane;
}

std::vector<Plane> channel_mean_map(const ImagePair& pair) {
    return {mean_similarity(pair.reference_codes, pair.test_codes, 1)};
}

}  // namespace

Plane mean_similarity(const HostImage& x, const HostImage& y, double range) {
    Plane map(x.extent);
    map.margin = radius;
    for (int c = 0; c < 3; ++c) {
        const Plane of_channel = similarity(channel(x, c), channel(y, c), range);
        for (size_t i = 0; i < map.values.size(); ++i) map.values[i] += of_channel.values[i] / 3;
    }
    return map;
}

std::vector<Metric> ssim_metrics() {
    using enum Better;
    return {
        {"ssim", "ssim_gauss1.5_channels", "1", higher,
         "Mean SSIM of the three channels of sRGB codes, Gaussian window 11x11 of sigma 1.5, biased covariance, "
         "windows within "
         "the image (Wang et al. 2004)",
         channel_mean_map, pooled_mean},
    };
}
