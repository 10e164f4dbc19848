#include "metrics/cvvdp/pyramid.h"

#include "core/error.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <bit>

// The Laplacian pyramid of Burt and Adelson 1983, "The Laplacian Pyramid as a Compact Image Code", with a = 0.4.

namespace {

constexpr float k0 = 0.05f, k1 = 0.25f, k2 = 0.4f;  // of distances 2, 1 and 0

/// The row or column `i` of `size`, continued by its mirror image with the edge doubled. -2 <= i <= size + 1.
unsigned mirrored(int i, unsigned size) {
    if (i < 0) return unsigned(-1 - i);
    return unsigned(i) < size ? unsigned(i) : 2 * size - 1 - unsigned(i);
}

void weigh_rows(const float* __restrict a, const float* __restrict b, const float* __restrict c,
                const float* __restrict d, const float* __restrict e, float* __restrict out, unsigned width) {
    for (unsigned x = 0; x < width; ++x) out[x] = k0 * (a[x] + e[x]) + k1 * (b[x] + d[x]) + k2 * c[x];
}

/// `row` has two zeros before its first and after its last pixel.
void halve_row(const float* __restrict row, float* __restrict out, unsigned out_width) {
    for (unsigned i = 0; i < out_width; ++i) {
        const float* p = row + 2 * i;
        out[i] = k0 * (p[0] + p[4]) + k1 * (p[1] + p[3]) + k2 * p[2];
    }
}

void double_row(const float* __restrict padded, float* __restrict out, unsigned width) {
    for (unsigned i = 0; i < width / 2; ++i) {
        out[2 * i] = 0.1f * (padded[i] + padded[i + 2]) + 0.8f * padded[i + 1];
        out[2 * i + 1] = 0.5f * (padded[i + 1] + padded[i + 2]);
    }
    if (const unsigned i = width / 2; width % 2 == 1)
        out[2 * i] = 0.1f * (padded[i] + padded[i + 2]) + 0.8f * padded[i + 1];
}

}  // namespace

std::vector<double> band_frequencies(glm::uvec2 extent, double pixels_per_degree) {
    const unsigned side = std::min(extent.x, extent.y);
    if (side < least_pyramid_side)
        fail("cvvdp needs images of at least ", least_pyramid_side, "x", least_pyramid_side, " pixels, but these have ",
             extent.x, "x", extent.y);
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000))
        fail("pixels per degree = ", pixels_per_degree, " is outside [1, 1000]");
    constexpr double second_band = 0.3228;   // peak of the pyramid's band 1, relative to the Nyquist frequency
    constexpr double least_frequency = 0.2;  // the first band at or below is the last but one
    constexpr double base_frequency = 0.1;   // of the base band, whatever its real one
    const double nyquist = pixels_per_degree / 2;
    const unsigned most_levels = unsigned(std::bit_width(side)) - 2;
    std::vector<double> frequencies = {nyquist};
    while (frequencies.size() < most_levels && frequencies.back() > least_frequency)
        frequencies.push_back(second_band * nyquist / double(1u << (frequencies.size() - 1)));
    frequencies.push_back(base_frequency);
    return frequencies;
}

void reduce(const FloatPlane& fine, FloatPlane& coarse) {
    tbb::parallel_for(0u, coarse.height, [&](unsigned y) {
        const unsigned width = fine.width;
        std::vector<float> padded(width + 4);
        float* row = padded.data() + 2;
        const auto source = [&](int offset) { return fine.row(mirrored(int(2 * y) + offset, fine.height)); };
        weigh_rows(source(-2), source(-1), source(0), source(1), source(2), row, width);
        float* out = coarse.row(y);
        halve_row(padded.data(), out, coarse.width);
        out[0] += k1 * row[0] + k0 * row[1];
        // By the parity of the height, as the original.
        out[coarse.width - 1] += fine.height % 2 == 1 ? k1 * row[width - 1] + k0 * row[width - 2] : k0 * row[width - 1];
    });
}

void expand_row(const FloatPlane& coarse, unsigned y, float* row, unsigned width, std::vector<float>& scratch) {
    const unsigned coarse_width = (width + 1) / 2;
    scratch.resize(coarse_width + 2);
    float* padded = scratch.data();
    const unsigned i = y / 2;
    const float* here = coarse.row(i);
    const float* below = coarse.row(std::min(i + 1, coarse.height - 1));
    if (y % 2 == 0) {
        const float* above = coarse.row(i == 0 ? 0 : i - 1);
        for (unsigned x = 0; x < coarse_width; ++x) padded[x + 1] = 0.1f * (above[x] + below[x]) + 0.8f * here[x];
    } else {
        for (unsigned x = 0; x < coarse_width; ++x) padded[x + 1] = 0.5f * (here[x] + below[x]);
    }
    padded[0] = padded[1], padded[coarse_width + 1] = padded[coarse_width];
    double_row(padded, row, width);
}

std::vector<glm::uvec2> coarser_sizes(glm::uvec2 extent, unsigned levels) {
    std::vector<glm::uvec2> sizes;
    for (unsigned l = 0; l < levels; ++l) sizes.push_back(extent = (extent + 1u) / 2u);
    return sizes;
}
