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
    const auto radius_at = [](double z) { return std::sqrt(std::max(0.0, 1 - z * z)); };
    std::array<double, scan_steps + 1> scan_z, scan_radius;
    for (int i = 0; i <= scan_steps; ++i) {
        const double t = double(i) / scan_steps;
        scan_z[i] = -v_z + t * t * (1 + v_z);
        scan_radius[i] = radius_at(scan_z[i]);
    }

    // Integrates over the spherical cap of sample_ggx_normal(), whose measure absorbs the density of visible normals.
    // For each azimuth the reflection is above the horizon on one or two intervals of z, found by scanning.
    glm::dvec2 sum(0.0);
    for (const glm::dvec2& azimuth : along_azimuth) {
        // Cubic steps crowd the nodes where the azimuth is opposite to the viewer's and the integrand changes fastest.
        const double from_back = azimuth.x * azimuth.x * azimuth.x, azimuth_step = 3 * azimuth.x * azimuth.x;
        const double c = -std::cos(M_PI * from_back), s = std::sqrt(1 - c * c);
        const auto normal = [&](double z, double r) {
            return glm::dvec3(alpha * (r * c + v_x), alpha * r * s, std::max(0.0, z + v_z));
        };
        // The sign of mu_i, without its divisions.
        const auto is_reflection_above = [&](double z, double r) {
            const glm::dvec3 n = normal(z, r);
            return 2 * (sin_o * n.x + mu_o * n.z) * n.z > mu_o * glm::dot(n, n);
        };
        const auto crossing = [&](double a, double b) {
            const bool starts_above = is_reflection_above(a, radius_at(a));
            for (int step = 0; step < 40; ++step) {
                const double middle = 0.5 * (a + b);
                (is_reflection_above(middle, radius_at(middle)) == starts_above ? a : b) = middle;
            }
            return 0.5 * (a + b);
        };
        const auto integrate = [&](double from, double to) {
            for (const glm::dvec2& cap : along_cap) {
                // Smooth steps at both ends soften the square roots there.
                const double t = cap.x * cap.x * (3 - 2 * cap.x), step = 6 * cap.x * (1 - cap.x);
                const double z = from + t * (to - from);
                const glm::dvec3 n = normal(z, radius_at(z));
                const double length2 = glm::dot(n, n), o_n = sin_o * n.x + mu_o * n.z;
                const double mu_i = 2 * o_n * n.z / length2 - mu_o;
                if (!(mu_i > 0)) continue;  // nor where the normal vanishes
                const double root_i = std::sqrt(a2 + (1 - a2) * mu_i * mu_i);
                const double weight = mu_i * (mu_o + root_o) / (mu_o * root_i + mu_i * root_o);
                const double f = std::max(0.0, 1 - o_n / std::sqrt(length2)), w = f * f * f * f * f;
                sum +=
                    azimuth.y * azimuth_step * cap.y * step * (to - from) / (1 + v_z) * weight * glm::dvec2(1 - w, w);
            }
        };
        double from = -v_z;
        bool is_above = false;
        for (int i = 1; i <= scan_steps; ++i) {
            if (is_reflection_above(scan_z[i], scan_radius[i]) != is_above) {
                const double root = crossing(scan_z[i - 1], scan_z[i]);
                if (is_above) integrate(from, root);
                from = root;
                is_above = !is_above;
            }
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
