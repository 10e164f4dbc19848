#include "metrics/noise.h"

#include "metrics/pooling.h"
#include "metrics/tiles.h"

#include <algorithm>
#include <cmath>
#include <random>

Plane cross_error(const HostImage& test, const HostImage& half_a, const HostImage& half_b, const HostImage& weighing,
                  double (*weight)(double)) {
    Plane map(test.extent);
    for (size_t i = 0; i < map.values.size(); ++i) {
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double x = test.values[c];
            map.values[i] += weight(weighing.values[c]) * (x - half_a.values[c]) * (x - half_b.values[c]) / 3;
        }
    }
    return map;
}

HostImage without_noise(const HostImage& half_a, const HostImage& half_b) {
    HostImage out(half_a.extent, 3);
    const auto clamped = [](unsigned i, int step, unsigned size) {
        return unsigned(std::clamp(int(i) + step, 0, int(size) - 1));
    };
    tbb::parallel_for(0u, out.extent.y, [&](unsigned y) {
        for (unsigned x = 0; x < out.extent.x; ++x)
            for (int c = 0; c < 3; ++c) {
                double neighbours = 0, variance = 0;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const unsigned px = clamped(x, dx, out.extent.x), py = clamped(y, dy, out.extent.y);
                        const double a = half_a.pixel(px, py)[c], b = half_b.pixel(px, py)[c];
                        variance += (a - b) * (a - b) / 4 / 9;
                        if (dx != 0 || dy != 0) neighbours += (a + b) / 2 / 8;
                    }
                const double own = (double(half_a.pixel(x, y)[c]) + half_b.pixel(x, y)[c]) / 2;
                const double distance = (own - neighbours) * (own - neighbours);
                const double kept = distance > 4 * variance ? 1 - 4 * variance / distance : 0.0;
                out.pixel(x, y)[c] = float(variance == 0 ? own : neighbours + kept * (own - neighbours));
            }
    });
    return out;
}

double noise_half_width(const Plane& swapped, const Mask& mask) {
    constexpr unsigned draws = 2000, seed = 0x5eed;
    std::vector<double> sums = tile_sums(swapped, mask);
    std::erase(sums, 0.0);

    std::mt19937_64 random(seed);
    std::vector<double> sizes(draws);
    for (double& size : sizes) {
        double sum = 0;
        uint64_t bits = 0;
        for (size_t i = 0; i < sums.size(); ++i) {
            if (i % 64 == 0) bits = random();
            sum += bits >> (i % 64) & 1 ? sums[i] : -sums[i];
        }
        size = std::abs(sum);
    }
    // The sums are symmetric about 0, so the 95 % quantile of their sizes bounds the central 95 %.
    const auto quantile = sizes.begin() + draws * 95 / 100;
    std::ranges::nth_element(sizes, quantile);
    return *quantile / double(pooled_count(swapped, mask));
}
