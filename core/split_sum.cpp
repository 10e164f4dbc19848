#include "core/split_sum.h"

#include "core/shared/brdf.h"
#include "core/shared/split_sum_tap.h"

#include <tbb/parallel_for.h>
#include <array>
#include <cmath>

namespace {

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1], by Newton's method on the Legendre polynomial.
template <int n>
std::array<glm::dvec2, n> gauss_legendre() {
    std::array<glm::dvec2, n> rule;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 0;
        for (int step = 0; step < 50; ++step) {
            double before = 1, value = x;
            for (int k = 2; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = n * (x * value - before) / (x * x - 1);
            const double change = value / slope;
            x -= change;
            if (std::abs(change) < 1e-15) break;
        }
        rule[i] = {0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope)};
    }
    return rule;
}

const auto along_azimuth = gauss_legendre<48>();
const auto along_cap = gauss_legendre<24>();
constexpr int scan_steps = 64;

}  // namespace

glm::dvec2 split_sum(double mu_o, double alpha) {
    const double sin_o = std::sqrt(std::max(0.0, 1 - mu_o * mu_o)), a2 = alpha * alpha;
    const double root_o = std::sqrt(a2 + (1 - a2) * mu_o * mu_o);
    const double length = std::sqrt(a2 * sin_o * sin_o + mu_o * mu_o);
    const double v_x = alpha * sin_o / length, v_z = mu_o / length;

    // Integrates over the spherical cap of sample_ggx_normal(), whose measure absorbs the density of visible normals.
    // For each azimuth the reflection is above the horizon on one or two intervals of z, found by scanning.
    glm::dvec2 sum(0.0);
    for (const glm::dvec2& azimuth : along_azimuth) {
        // Cubic steps crowd the nodes where the azimuth is opposite to the viewer's and the integrand changes fastest.
        const double from_back = azimuth.x * azimuth.x * azimuth.x, azimuth_step = 3 * azimuth.x * azimuth.x;
        const double c = -std::cos(M_PI * from_back);
        const auto reflect = [&](double z, double& o_m) {
            const double r = std::sqrt(std::max(0.0, 1 - z * z));
            const double n_x = alpha * (r * c + v_x), n_y2 = a2 * r * r * (1 - c * c), n_z = std::max(0.0, z + v_z);
            const double norm = std::sqrt(n_x * n_x + n_y2 + n_z * n_z);
            o_m = norm > 0 ? (sin_o * n_x + mu_o * n_z) / norm : 0;
            return norm > 0 ? 2 * o_m * n_z / norm - mu_o : -1.0;  // mu_i
        };
        double o_m;
        const auto crossing = [&](double a, double b) {
            const bool starts_above = reflect(a, o_m) > 0;
            for (int step = 0; step < 40; ++step) {
                const double middle = 0.5 * (a + b);
                ((reflect(middle, o_m) > 0) == starts_above ? a : b) = middle;
            }
            return 0.5 * (a + b);
        };
        const auto integrate = [&](double from, double to) {
            for (const glm::dvec2& cap : along_cap) {
                // Smooth steps at both ends soften the square roots there.
                const double t = cap.x * cap.x * (3 - 2 * cap.x), step = 6 * cap.x * (1 - cap.x);
                const double mu_i = reflect(from + t * (to - from), o_m);
                if (mu_i <= 0) continue;
                const double root_i = std::sqrt(a2 + (1 - a2) * mu_i * mu_i);
                const double weight = mu_i * (mu_o + root_o) / (mu_o * root_i + mu_i * root_o);
                const double w = std::pow(std::max(0.0, 1 - o_m), 5);
                sum +=
                    azimuth.y * azimuth_step * cap.y * step * (to - from) / (1 + v_z) * weight * glm::dvec2(1 - w, w);
            }
        };
        double from = -v_z, z = -v_z;
        bool is_above = false;
        for (int i = 1; i <= scan_steps; ++i) {
            const double t = double(i) / scan_steps, next = -v_z + t * t * (1 + v_z);
            if ((reflect(next, o_m) > 0) != is_above) {
                const double root = crossing(z, next);
                if (is_above) integrate(from, root);
                from = root;
                is_above = !is_above;
            }
            z = next;
        }
        if (is_above) integrate(from, 1);
    }
    return sum;
}

HostImage split_sum_table(unsigned size) {
    HostImage table({size, size}, 2);
    tbb::parallel_for(0u, size, [&](unsigned row) {
        const float roughness = (float(row) + 0.5f) / float(size);
        for (unsigned column = 0; column < size; ++column) {
            const glm::dvec2 factors = split_sum((column + 0.5) / size, ggx_alpha(roughness));
            table.pixel(column, row)[0] = float(factors.x);
            table.pixel(column, row)[1] = float(factors.y);
        }
    });
    return table;
}

const HostImage& default_split_sum_table() {
    static const HostImage table = split_sum_table();
    return table;
}

glm::vec2 read_split_sum(const HostImage& table, float mu_o, float roughness) {
    const SplitSumTap tap = split_sum_tap(mu_o, roughness, table.extent.x);
    const auto texel = [&](unsigned x, unsigned y) {
        const float* p = table.pixel(x, y);
        return glm::vec2(p[0], p[1]);
    };
    const glm::vec2 low = glm::mix(texel(tap.first.x, tap.first.y), texel(tap.last.x, tap.first.y), tap.fraction.x);
    const glm::vec2 high = glm::mix(texel(tap.first.x, tap.last.y), texel(tap.last.x, tap.last.y), tap.fraction.x);
    return glm::mix(low, high, tap.fraction.y);
}
