#include "variants/common/lobe_horizon.h"
#include "tests/variants/lobe_quadrature.h"
#include "variants/common/horizon_image.h"
#include "variants/frostbite_sssr/lobe_cone.h"

#include <gtest/gtest.h>
#include <algorithm>

// What of a truncated lobe goes below the horizon, and which cone holds half of the rest, against integrals over its
// directions.

namespace {

double share_below(const LobeCase& c) {
    return mean_over_lobe(c, [](glm::dvec3 i) { return i.z <= 0; });
}

TEST(LobeHorizon, HasTheShareOfTheIntegral) {
    double largest = 0;
    for (const unsigned lobe : {lobe_of_normals, lobe_of_visible_normals})
        for (const float roughness : {0.2f, 0.5f, 0.8f, 1.0f})
            for (const float view : {0.0f, 45.0f, 75.0f, 87.0f})
                for (const float bias : {0.0f, 0.15f, 0.7f}) {
                    const LobeCase c{lobe, roughness, view, bias};
                    const double expected = share_below(c), mu_o = c.o().z;
                    // 3e-3 is the integral's own error.
                    EXPECT_NEAR(share_below_horizon(lobe, mu_o, c.alpha(), bias), expected, 4e-3) << name_of(c);
                    largest = std::max(largest, expected);
                }
    EXPECT_GT(largest, 0.4);
}

TEST(LobeHorizon, IsReadBetweenTheTexelsOfItsTable) {
    for (const unsigned lobe : {lobe_of_normals, lobe_of_visible_normals})
        for (const float bias : {0.0f, 0.7f}) {
            const HostImage table = horizon_table(lobe, bias);
            for (unsigned y = 0; y + 1 < table.extent.y; y += 3)
                for (unsigned x = 0; x + 1 < table.extent.x; ++x) {
                    const double read = 0.25 * (*table.pixel(x, y) + *table.pixel(x + 1, y) + *table.pixel(x, y + 1) +
                                                *table.pixel(x + 1, y + 1));
                    const double mu_o = (x + 1.0) / table.extent.x, roughness = (y + 1.0) / table.extent.y;
                    const double truth = share_below_horizon(lobe, mu_o, ggx_alpha(float(roughness)), bias);
                    EXPECT_NEAR(read, truth, x < 3 ? 0.1 : 0.01) << lobe << ", " << bias << ": " << x << ", " << y;
                }
        }
}

/// Share of the directions above the horizon within a cone about their mean.
double share_in_cone(const LobeCase& c, double tangent) {
    glm::dvec3 mean(0);
    for (const int axis : {0, 2})  // the other half of the lobe mirrors it
        mean[axis] = mean_over_lobe(c, [&](glm::dvec3 i) { return i.z > 0 ? i[axis] : 0; });
    mean = normalize(mean);
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    const double inside = mean_over_lobe(c, [&](glm::dvec3 i) { return i.z > 0 && dot(i, mean) > cosine; });
    return inside / (1 - share_below(c));
}

/// Seen along the normal: half of what both lobes hold, whatever is cut off. 3e-3 is the integral's own error.
TEST(LobeCone, HoldsHalfOfTheLobeSeenAlongTheNormal) {
    for (const unsigned lobe : {lobe_of_normals, lobe_of_visible_normals})
        for (const float roughness : {0.1f, 0.3f, 0.5f})
            for (const float bias : {0.15f, 0.7f, 0.95f}) {
                const LobeCase c{lobe, roughness, 0, bias};
                EXPECT_NEAR(share_in_cone(c, lobe_cone_tangent(c.alpha(), bias)), 0.5, 4e-3) << name_of(c);
            }
}

/// At an angle: half of a lobe that the horizon does not cut, within 5 %; else 34 to 68 %.
TEST(LobeCone, NarrowsAsTheLobeDoesAtAnAngle) {
    for (const unsigned lobe : {lobe_of_normals, lobe_of_visible_normals})
        for (const float roughness : {0.1f, 0.3f, 0.5f})
            for (const float view : {45.0f, 60.0f, 75.0f, 82.0f})
                for (const float bias : {0.15f, 0.7f}) {
                    const LobeCase c{lobe, roughness, view, bias};
                    const double below = share_below(c);
                    const double tangent = lobe_cone_tangent(c.alpha(), bias) * lobe_cone_narrowing(c.o().z);
                    const double share = share_in_cone(c, tangent);
                    EXPECT_NEAR(share, 0.5, below < 0.01 ? 0.05 : 0.18) << name_of(c);
                }
}

}  // namespace
