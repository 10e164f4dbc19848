#include "metrics/cvvdp/opponent.h"

#include <tbb/parallel_for.h>
#include <cmath>
#include <numeric>

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

constexpr Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

// Rec. 709 to XYZ; to cones of CIE 2006, as the authors fitted them; to the opponent colours of castleCSF (Ashraf et
// al. 2024, Journal of Vision 24(4):5).
constexpr Matrix xyz_from_rgb = {{{0.4124564, 0.3575761, 0.1804375},  //
                                  {0.2126729, 0.7151522, 0.0721750},
                                  {0.0193339, 0.1191920, 0.9503041}}};
constexpr Matrix cones_from_xyz = {{{0.187596268556126, 0.585168649077728, -0.026384263306304},
                                    {-0.133397430663221, 0.405505777260049, 0.034502127690364},
                                    {0.000244379021663, -0.000542995890619, 0.019406849066323}}};
constexpr Matrix opponent_from_cones = {{{1, 1, 0},  //
                                         {1, -2.311130179947035, 0},
                                         {-1, -1, 50.977571328718781}}};
constexpr Matrix opponent_from_rgb = product(opponent_from_cones, product(cones_from_xyz, xyz_from_rgb));

void opponent_row(const float* __restrict rgb, float* __restrict a, float* __restrict rg, float* __restrict yv,
                  unsigned width) {
    std::array<float, 9> m;
    for (int i = 0; i < 9; ++i) m[i] = float(opponent_from_rgb[i / 3][i % 3]);
    for (unsigned x = 0; x < width; ++x) {
        const float r = rgb[3 * x], g = rgb[3 * x + 1], b = rgb[3 * x + 2];
        a[x] = m[0] * r + m[1] * g + m[2] * b;
        rg[x] = m[3] * r + m[4] * g + m[5] * b;
        yv[x] = m[6] * r + m[7] * g + m[8] * b;
    }
}

bool has_non_finite(const float* values, size_t count) {
    // 0 times NaN or Inf is NaN, which no sum loses. Sixteen sums, for the vectoriser.
    float sums[16] = {};
    size_t i = 0;
    for (; i + 16 <= count; i += 16)
        for (int k = 0; k < 16; ++k) sums[k] += 0.0f * values[i + k];
    float sum = std::accumulate(sums, sums + 16, 0.0f);
    for (; i < count; ++i) sum += 0.0f * values[i];
    return std::isnan(sum);
}

bool is_finite_pixel(const float* p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/// Pixels that are not finite in both rows become black in both; their number.
size_t blacken_non_finite(std::vector<float>& a, std::vector<float>& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.size(); i += 3)
        if (!is_finite_pixel(&a[i]) || !is_finite_pixel(&b[i])) {
            ++count;
            for (size_t c = i; c < i + 3; ++c) a[c] = b[c] = 0;
        }
    return count;
}

}  // namespace

size_t to_opponent(const HostImage& reference, const HostImage& test, const Viewing& viewing,
                   std::span<FloatPlane> reference_out, std::span<FloatPlane> test_out) {
    const unsigned width = reference.extent.x;
    const size_t row_size = size_t(width) * 3;
    std::vector<size_t> blackened(reference.extent.y);
    tbb::parallel_for(0u, reference.extent.y, [&](unsigned y) {
        const float* rows[2] = {reference.pixel(0, y), test.pixel(0, y)};
        std::vector<float> finite[2], light(row_size);
        if (has_non_finite(rows[0], row_size) || has_non_finite(rows[1], row_size)) {
            for (int i = 0; i < 2; ++i) finite[i].assign(rows[i], rows[i] + row_size);
            blackened[y] = blacken_non_finite(finite[0], finite[1]);
            for (int i = 0; i < 2; ++i) rows[i] = finite[i].data();
        }
        for (int i = 0; i < 2; ++i) {
            const std::span<FloatPlane> out = i == 0 ? reference_out : test_out;
            displayed_light(viewing, rows[i], light.data(), row_size);
            opponent_row(light.data(), out[0].row(y), out[1].row(y), out[2].row(y), width);
        }
    });
    return std::accumulate(blackened.begin(), blackened.end(), size_t(0));
}
