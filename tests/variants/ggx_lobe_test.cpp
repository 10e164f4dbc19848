#include "tests/variants/lobe_quadrature.h"

#include <gtest/gtest.h>
#include <random>

// Truncated lobes: what is drawn against densities written down here once more, in double precision.

namespace {

using glm::dvec2, glm::dvec3;

std::vector<LobeCase> cases(const std::vector<float>& biases) {
    std::vector<LobeCase> all;
    for (const unsigned lobe : {lobe_of_normals, lobe_of_visible_normals})
        for (const float roughness : {0.1f, 0.3f, 0.5f, 1.0f})
            for (const float view : {0.0f, 60.0f, 85.0f})
                for (const float bias : biases) all.push_back({lobe, roughness, view, bias});
    return all;
}

// --- Chi-square over cells of equal shares of the distribution of normals, whose sides mirror each other ---

constexpr int rings = 24, sectors = 24;

double cell_probability(const LobeCase& c, int ring, int sector) {
    const int steps = 24;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double share = (ring + (i + 0.5) / steps) / rings;
            double solid_angle;
            const dvec3 m = lobe_normal(c, share, 2 * M_PI * (sector + (k + 0.5) / steps) / sectors, solid_angle);
            sum += lobe_normal_density(c, m) * solid_angle;
        }
    return sum / (steps * steps * rings * sectors);
}

/// Deviation of a chi-square from its mean in standard deviations of a normal variable: Wilson and Hilferty 1931.
double deviation(double chi_square, double degrees) {
    const double spread = 2 / (9 * degrees);
    return (std::cbrt(chi_square / degrees) - (1 - spread)) / std::sqrt(spread);
}

glm::vec2 uniform_pair(std::mt19937& random) {
    return {float(random() >> 8) * 0x1p-24f, float(random() >> 8) * 0x1p-24f};
}

glm::vec3 sample_normal(const LobeCase& c, glm::vec2 u) {
    return c.lobe == lobe_of_normals ? sample_truncated_normal(c.alpha(), c.bias, u)
                                     : sample_truncated_visible_normal(c.o(), c.alpha(), c.bias, u);
}

double chi_square_deviation(const LobeCase& c, std::mt19937& random) {
    const int samples = 40000;
    std::vector<double> count(size_t(rings * sectors), 0.0);
    const double a2 = double(c.alpha()) * c.alpha();
    for (int n = 0; n < samples; ++n) {
        const dvec3 m = sample_normal(c, uniform_pair(random));
        const double tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z);
        const int ring = std::min(int(tan2 / (a2 + tan2) * rings), rings - 1);
        const double turns = std::atan2(m.y, m.x) / (2 * M_PI);
        count[size_t(ring * sectors + std::min(int((turns - std::floor(turns)) * sectors), sectors - 1))] += 1;
    }
    double chi_square = 0, rare = 0, rare_count = 0;
    int cells = 0;
    const auto add = [&](double expected, double found) {
        chi_square += (found - expected) * (found - expected) / expected;
        ++cells;
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int sector = 0; sector < sectors / 2; ++sector) {
            const double expected = samples * cell_probability(c, ring, sector);
            for (const int side : {sector, sectors - 1 - sector}) {
                const double found = count[size_t(ring * sectors + side)];
                if (expected >= 10) {
                    add(expected, found);
                } else {  // a chi-square needs some in each cell
                    rare += expected;
                    rare_count += found;
                }
            }
        }
    if (rare >= 10)
        add(rare, rare_count);
    else
        EXPECT_LT(rare_count, rare + 40) << name_of(c);
    return deviation(chi_square, cells - 1);
}

TEST(GgxLobe, TruncatedNormalsHaveTheirClosedFormDensity) {
    // 4.9 standard deviations: one false alarm in two million for each of the 96 cases, one in 20000 for all.
    std::mt19937 random(7);
    double largest = 0;
    for (const LobeCase& c : cases({0, 0.1f, 0.7f, 0.95f})) {
        const double found = chi_square_deviation(c, random);
        EXPECT_LT(found, 4.9) << name_of(c);
        largest = std::max(largest, found);
    }
    EXPECT_GT(largest, 1);  // of 96 fair ones: cells that are too alike were not drawn
}

TEST(GgxLobe, NarrowsToTheConeOfItsBias) {
    std::mt19937 random(8);
    for (const LobeCase& c : cases({0.1f, 0.7f, 0.95f})) {
        if (c.lobe == lobe_of_visible_normals && c.view_degrees != 0) continue;
        const double limit = c.alpha() * std::sqrt((1 - c.bias) / c.bias);
        double largest = 0;
        for (int n = 0; n < 20000; ++n) {
            const glm::vec3 m = sample_normal(c, uniform_pair(random));
            largest = std::max(largest, double(glm::length(glm::vec2(m))) / m.z);
        }
        EXPECT_LT(largest, limit * (1 + 1e-4)) << name_of(c);  // rounding of u and of 1 - m.z^2
        EXPECT_GT(largest, limit * 0.99) << name_of(c);        // a hundredth of the cone's rim holds 1 % of it and more
    }
}

TEST(GgxLobe, OfVisibleNormalsNarrowsAboutTheMirrorAtEveryView) {
    std::mt19937 random(9);
    for (const LobeCase& c : cases({0.99f})) {
        if (c.lobe != lobe_of_visible_normals) continue;
        EXPECT_TRUE(is_left_by_truncation(c, {0, 0, 1})) << name_of(c);
        double farthest = 0;
        for (int n = 0; n < 5000; ++n) {
            const glm::vec3 m = sample_normal(c, uniform_pair(random));
            farthest = std::max(farthest, double(glm::length(glm::vec2(m))) / m.z / c.alpha());
        }
        // A disk of a tenth of the radius reaches 0.2 from the mirror's place at most, where normals move by up to
        // twice as much, or by more where the mirror's place is at the rim.
        EXPECT_LT(farthest, c.view_degrees > 80 ? 1.0 : 0.4) << name_of(c);
    }
}

// --- Densities of directions ---

/// The integral of `density` over the sphere, in rings about the mirror direction that widen outwards.
template <class Density>
double integral_over_directions(const LobeCase& c, const Density& density) {
    const glm::vec3 o = c.o();
    const mat3 frame = basis_from_normal({-o.x, -o.y, o.z});
    const int bands = 600, turns = 360;
    double sum = 0;
    for (int band = 0; band < bands; ++band) {
        const double from = M_PI * std::pow(double(band) / bands, 2), to = M_PI * std::pow((band + 1.0) / bands, 2);
        const double polar = (from + to) / 2, solid_angle = (std::cos(from) - std::cos(to)) * 2 * M_PI / turns;
        for (int turn = 0; turn < turns; ++turn) {
            const double azimuth = 2 * M_PI * (turn + 0.5) / turns;
            sum += solid_angle * density(frame * glm::vec3(std::sin(polar) * std::cos(azimuth),
                                                           std::sin(polar) * std::sin(azimuth), std::cos(polar)));
        }
    }
    return sum;
}

TEST(GgxLobe, DensityOfDirectionsIntegratesToOne) {
    for (const LobeCase& c : cases({0, 0.7f})) {
        // Rings of this width see no narrower lobe, and normals mirror grazing views into a pole straight on.
        if (c.roughness < 0.3f || c.view_degrees > 60) continue;
        const double integral = integral_over_directions(c, [&](glm::vec3 i) {
            dvec3 m = normalize(dvec3(c.o()) + dvec3(i));
            if (m.z < 0) m = -m;
            return is_left_by_truncation(c, m) ? lobe_density(c.lobe, c.o(), i, c.alpha()) / (1 - c.bias) : 0;
        });
        EXPECT_NEAR(integral, 1, 0.01) << name_of(c);
    }
}

TEST(GgxLobe, SamplesKnowTheirDensity) {
    std::mt19937 random(10);
    unsigned below_horizon = 0, facing_away = 0;
    for (const LobeCase& c : cases({0, 0.1f, 0.7f}))
        for (int n = 0; n < 2000; ++n) {
            const glm::vec2 u = uniform_pair(random);
            const dvec3 o = c.o(), m = sample_normal(c, u);
            const LobeSample drawn = sample_lobe(c.lobe, c.o(), c.alpha(), c.bias, u);
            // The density of the mirrored direction is that of the normal over 4 |o . m| (Walter et al. 2007, eq. 38).
            const double density = lobe_normal_density({c.lobe, c.roughness, c.view_degrees, 0}, m) / (1 - c.bias) /
                                   (4 * std::abs(dot(o, m)));
            ASSERT_GT(drawn.inverse_density, 0) << name_of(c);
            // Float32 gives m, from o + i, to 1e-7 / (2 |o . m|).
            if (std::abs(dot(o, m)) < 1e-2 || m.z < 1e-2) continue;
            ASSERT_NEAR(drawn.inverse_density * density, 1, 2e-3) << name_of(c);
            const double of_direction = lobe_density(c.lobe, c.o(), drawn.direction, c.alpha()) / (1 - c.bias);
            ASSERT_NEAR(of_direction / density, 1, 5e-3) << name_of(c);
            below_horizon += drawn.direction.z < 0;
            facing_away += dot(o, m) < 0;
        }
    EXPECT_GT(below_horizon, 1000u);
    EXPECT_GT(facing_away, 1000u);
}

}  // namespace
