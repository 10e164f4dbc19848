#include "metrics/ssim.h"

#include "core/error.h"
#include "metrics/pooling.h"

#include <algorithm>
#include <array>
#include <cmath>

// SSIM: Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", with its Gaussian window, biased covariance, and only windows that lie within the image, as the authors'
// program has them. MS-SSIM: Wang, Simoncelli, Bovik 2003, "Multiscale Structural Similarity for Image Quality
// Assessment".

namespace {

constexpr int radius = 5;
constexpr unsigned window = 2 * radius + 1;
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // (K L)^2 with L = 1, the range of codes
constexpr std::array<double, 5> scale_weights = {0.0448, 0.2856, 0.3001, 0.2363,
                                                 0.1333};  // finest first; 2003, section 4

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

struct Similarity {
    Plane structure;  ///< (2 s_xy + C2) / (s_xx + s_yy + C2)
    Plane full;       ///< times (2 mu_x mu_y + C1) / (mu_x^2 + mu_y^2 + C1)
};

/// `covariance_scale` is 1 but for sample covariances.
Similarity similarity(const Plane& x, const Plane& y, double covariance_scale) {
    if (x.extent.x < window || x.extent.y < window)
        fail("ssim needs images of at least ", window, "x", window, " pixels, but these have ", x.extent.x, "x",
             x.extent.y);
    const Plane mean_x = windowed(x), mean_y = windowed(y);
    const Plane xx = windowed(product(x, x)), yy = windowed(product(y, y)), xy = windowed(product(x, y));
    Similarity s{Plane(x.extent), Plane(x.extent)};
    s.structure.margin = s.full.margin = radius;
    for (size_t i = 0; i < x.values.size(); ++i) {
        const double mx = mean_x.values[i], my = mean_y.values[i];
        const double s_xx = covariance_scale * (xx.values[i] - mx * mx),
                     s_yy = covariance_scale * (yy.values[i] - my * my);
        const double s_xy = covariance_scale * (xy.values[i] - mx * my);
        s.structure.values[i] = (2 * s_xy + c2) / (s_xx + s_yy + c2);
        s.full.values[i] = (2 * mx * my + c1) / (mx * mx + my * my + c1) * s.structure.values[i];
    }
    return s;
}

Plane channel(const HostImage& image, int c) {
    Plane plane(image.extent);
    for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = image.values[i * 3 + c];
    return plane;
}

std::vector<Plane> channel_mean_map(const ImagePair& pair, double covariance_scale) {
    Plane map(pair.reference_codes.extent);
    map.margin = radius;
    for (int c = 0; c < 3; ++c) {
        const Plane full =
            similarity(channel(pair.reference_codes, c), channel(pair.test_codes, c), covariance_scale).full;
        for (size_t i = 0; i < map.values.size(); ++i) map.values[i] += full.values[i] / 3;
    }
    return {std::move(map)};
}

std::vector<Plane> channel_map(const ImagePair& pair) { return channel_mean_map(pair, 1); }

std::vector<Plane> sample_map(const ImagePair& pair) {
    constexpr double n = window * window;
    return channel_mean_map(pair, n / (n - 1));
}

/// Means of 2x2 pixels; an odd size repeats its last row or column.
Plane halved(const Plane& in) {
    Plane out((in.extent + 1u) / 2u);
    for (unsigned y = 0; y < out.extent.y; ++y)
        for (unsigned x = 0; x < out.extent.x; ++x) {
            const unsigned right = std::min(2 * x + 1, in.extent.x - 1), below = std::min(2 * y + 1, in.extent.y - 1);
            out.row(y)[x] =
                (in.row(2 * y)[2 * x] + in.row(2 * y)[right] + in.row(below)[2 * x] + in.row(below)[right]) / 4;
        }
    return out;
}

/// Layer 5 c + s belongs to scale s of channel c: `structure`, and at the coarsest scale `full`.
std::vector<Plane> multi_scale_maps(const ImagePair& pair) {
    constexpr unsigned smallest = window << (scale_weights.size() - 1);
    const glm::uvec2 extent = pair.reference_codes.extent;
    if (std::min(extent.x, extent.y) < smallest)
        fail("ms_ssim needs images of at least ", smallest, "x", smallest, " pixels, but these have ", extent.x, "x",
             extent.y);
    std::vector<Plane> layers;
    for (int c = 0; c < 3; ++c) {
        Plane x = channel(pair.reference_codes, c), y = channel(pair.test_codes, c);
        for (size_t s = 0; s < scale_weights.size(); ++s) {
            Similarity here = similarity(x, y, 1);
            const bool is_last = s + 1 == scale_weights.size();
            layers.push_back(is_last ? std::move(here.full) : std::move(here.structure));
            if (!is_last) x = halved(x), y = halved(y);
        }
    }
    return layers;
}

double weighted_mean(const Plane& plane, const Plane& weights) {
    const auto weight = [&](size_t i) { return plane.within_margin(i) ? weights.values[i] : 0.0; };
    return ordered_sum(plane.values.size(), [&](size_t i) { return weight(i) * plane.values[i]; }) /
           ordered_sum(plane.values.size(), weight);
}

/// At coarser scales a pixel counts by the share of it that lies inside the mask.
double multi_scale(std::span<const Plane> layers, const Mask& mask) {
    Plane weights(mask.extent);
    for (size_t i = 0; i < weights.values.size(); ++i) weights.values[i] = mask.inside[i] ? 1 : 0;
    std::array<double, 3> products = {1, 1, 1};
    for (size_t s = 0; s < scale_weights.size(); ++s) {
        for (size_t c = 0; c < 3; ++c) {
            const double m = weighted_mean(layers[scale_weights.size() * c + s], weights);
            products[c] *= std::pow(m < 0 ? 0 : m, scale_weights[s]);  // NaN stays NaN
        }
        weights = halved(weights);
    }
    return (products[0] + products[1] + products[2]) / 3;
}

}  // namespace

std::vector<Metric> ssim_metrics() {
    using enum Better;
    using enum Domain;
    return {
        {"ssim", "ssim_gauss1.5_channels", "1", higher, display,
         "mean SSIM of the three code channels, Gaussian window 11x11 of sigma 1.5, biased covariance, windows within "
         "the image (Wang et al. 2004)",
         channel_map, pooled_mean},
        {"ssim_sample", "ssim_gauss1.5_sample", "1", higher, display,
         "as ssim, with covariances of samples: times 121/120; to compare with other programs only (scikit-image's "
         "default)",
         sample_map, pooled_mean},
        {"ms_ssim", "ms_ssim_5", "1", higher, display,
         "five scales with the weights of Wang et al. 2003, mean of the three code channels; its map is that of the "
         "finest scale",
         multi_scale_maps, multi_scale},
    };
}
