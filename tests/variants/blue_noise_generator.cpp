#include "tests/variants/blue_noise_generator.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace {

constexpr int size = 128, texel_count = size * size;
constexpr int function_count = 19;

/// Test functions of one pair, times their weights, in units of 2^-12.
using Values = std::array<int32_t, function_count>;

struct Pair {
    uint8_t x, y;
};

/// Of one number u in [0, 1): itself, and two harmonics, so that the noise stays blue when it is rotated modulo 1. All
/// have mean 0 and variance 1.
std::array<double, 5> axis_functions(uint8_t code) {
    const double u = (code + 0.5) / 256, turn = 2 * std::numbers::pi * u;
    return {std::sqrt(12.0) * (u - 0.5), std::sqrt(2.0) * std::cos(turn), std::sqrt(2.0) * std::sin(turn),
            std::sqrt(2.0) * std::cos(2 * turn), std::sqrt(2.0) * std::sin(2 * turn)};
}

/// The functions of either number, and the products of the first three of each. The weights were chosen such that all
/// spectra match those of AMD's table: see tests/variants/blue_noise_spectrum_test.cpp.
Values test_functions(Pair pair) {
    const std::array<double, 5> axis_weights = {1.75, 0.7, 0.7, 0.35, 0.35};
    const std::array<double, 5> x = axis_functions(pair.x), y = axis_functions(pair.y);
    Values values;
    int count = 0;
    const auto add = [&](double weighted) { values[count++] = int32_t(std::lround(weighted * 4096)); };
    for (int i = 0; i < 5; ++i) add(axis_weights[i] * x[i]), add(axis_weights[i] * y[i]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) add((i + j == 0 ? 0.7 : 0.5) * x[i] * y[j]);
    return values;
}

/// A Gaussian low-pass with the standard deviation of 1.5 texels of Ulichney 1993, "The void-and-cluster method for
/// dither array generation", in units of 2^-10; 0 beyond 5 texels, where it is below 2^-8 of its peak.
struct Kernel {
    static constexpr int radius = 5, width = 2 * radius + 1;
    std::array<int32_t, width * width> weights;

    Kernel() {
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x)
                weights[(y + radius) * width + x + radius] =
                    int32_t(std::lround(1024 * std::exp(-(x * x + y * y) / 4.5)));
    }
    int32_t at(int x, int y) const {
        if (std::abs(x) > radius || std::abs(y) > radius) return 0;
        return weights[(y + radius) * width + x + radius];
    }
};

/// Random numbers: a hash of a counter (Wellons 2018, "Prospecting for Hash Functions", lowbias32).
struct Counter {
    uint32_t count = 0;
    uint32_t next() {
        uint32_t x = ++count * 0x9e3779b9u;
        x = (x ^ x >> 16) * 0x7feb352du;
        x = (x ^ x >> 15) * 0x846ca68bu;
        return x ^ x >> 16;
    }
};

/// The arrangement, and the low-pass filtered image of every test function, kept up to date: so a swap is rated without
/// a look at the neighbours, which are touched only when it is made. The plane wraps around.
struct Arrangement {
    Kernel kernel;
    std::vector<Pair> pairs = std::vector<Pair>(texel_count);
    std::vector<Values> values = std::vector<Values>(texel_count), filtered = values;

    void place(int texel, Pair pair) {
        const Values added = test_functions(pair);
        pairs[texel] = pair;
        values[texel] = added;
        add_filtered(texel, added);
    }

    void add_filtered(int texel, const Values& added) {
        for (int y = -Kernel::radius; y <= Kernel::radius; ++y)
            for (int x = -Kernel::radius; x <= Kernel::radius; ++x) {
                const int row = (texel / size + y) & (size - 1), column = (texel + x) & (size - 1);
                Values& sum = filtered[row * size + column];
                for (int f = 0; f < function_count; ++f) sum[f] += kernel.at(x, y) * added[f];
            }
    }

    /// Half of what exchanging the pairs of two texels adds to the energy: the sum over functions f and texels p, q of
    /// kernel(p - q) f(p) f(q).
    int64_t energy_added(int a, int b) const {
        const int wrapped_x = ((a - b + size / 2) & (size - 1)) - size / 2;
        const int wrapped_y = ((a / size - b / size + size / 2) & (size - 1)) - size / 2;
        const int64_t own = kernel.at(0, 0) - kernel.at(wrapped_x, wrapped_y);
        int64_t added = 0;
        for (int f = 0; f < function_count; ++f) {
            const int64_t difference = values[b][f] - values[a][f];
            added += difference * (filtered[a][f] - filtered[b][f] + own * difference);
        }
        return added;
    }

    void exchange(int a, int b) {
        Values to_a, to_b;
        for (int f = 0; f < function_count; ++f) {
            to_a[f] = values[b][f] - values[a][f];
            to_b[f] = -to_a[f];
        }
        add_filtered(a, to_a);
        add_filtered(b, to_b);
        std::swap(values[a], values[b]);
        std::swap(pairs[a], pairs[b]);
    }
};

/// Point `index` of the net: the upper 8 of its 14 bits, and the lower 8 in reverse.
Pair hammersley(int index) {
    uint8_t reversed = 0;
    for (int bit = 0; bit < 8; ++bit) reversed |= uint8_t((index >> bit & 1) << (7 - bit));
    return {uint8_t(index >> 6), reversed};
}

std::vector<Pair> shuffled_net(Counter& random) {
    std::vector<Pair> net(texel_count);
    for (int i = 0; i < texel_count; ++i) net[i] = hammersley(i);
    for (int i = texel_count - 1; i > 0; --i) std::swap(net[i], net[uint64_t(random.next()) * uint64_t(i + 1) >> 32]);
    return net;
}

}  // namespace

HostImage make_blue_noise_table() {
    Counter random;
    Arrangement arrangement;
    const std::vector<Pair> net = shuffled_net(random);
    for (int texel = 0; texel < texel_count; ++texel) arrangement.place(texel, net[texel]);

    const int trials = 10'000'000;  // low frequencies then have the energy that they have in AMD's table; more lower it
    for (int trial = 0; trial < trials; ++trial) {
        const uint32_t bits = random.next();
        const int a = bits & (texel_count - 1), b = bits >> 14 & (texel_count - 1);
        if (arrangement.energy_added(a, b) < 0) arrangement.exchange(a, b);
    }

    HostImage table({size, size}, 2);
    for (int texel = 0; texel < texel_count; ++texel) {
        table.values[texel * 2] = arrangement.pairs[texel].x / 255.0f;
        table.values[texel * 2 + 1] = arrangement.pairs[texel].y / 255.0f;
    }
    return table;
}
