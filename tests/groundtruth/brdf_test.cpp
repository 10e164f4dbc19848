#include "core/shared/brdf.h"

#include "core/split_sum.h"
#include "groundtruth/sampling/lobes.h"
#include "groundtruth/sampling/sobol.h"
#include "tests/groundtruth/ggx_densities.h"
#include "tests/groundtruth/vectors.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <numeric>

namespace {

vec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

/// Tail of the chi-square distribution as a standard normal deviate (Wilson and Hilferty 1931), good for 30 degrees and
/// more.
double normal_deviate(double chi_square, double degrees) {
    const double k = 2 / (9 * degrees);
    return (std::cbrt(chi_square / degrees) - (1 - k)) / std::sqrt(k);
}

/// Pearson's test of samples against a density over the hemisphere of +z, 30 x 60 cells in (cosine, azimuth), and one
/// cell for all samples below it. Returns the normal deviate of chi-square: beyond 5.2 with probability 1e-7 if all is
/// right.
double chi_square_deviate(const std::function<vec3(vec2)>& sample, const std::function<float(vec3)>& pdf,
                          uint64_t seed) {
    constexpr int rows = 30, columns = 60, panels = 3, samples = 200000;
    // Nodes and weights of Gauss-Legendre quadrature on [0, 1].
    constexpr double node[5] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                0.95308992296933200};
    constexpr double weight[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                  0.11846344252809454};
    std::vector<double> observed(rows * columns + 1, 0.0), expected(observed.size(), 0.0);
    uint64_t state = seed;
    for (int i = 0; i < samples; ++i) {
        const uint64_t bits = hash_bits_64(state += 0x9e3779b97f4a7c15ull);
        const vec3 d = sample({unit_float(uint32_t(bits)), unit_float(uint32_t(bits >> 32))});
        const double turns = std::atan2(d.y, d.x) / (2 * M_PI) + 0.5;
        const int row = std::min(rows - 1, int(d.z * rows)), column = std::min(columns - 1, int(turns * columns));
        observed[d.z <= 0 ? rows * columns : size_t(row * columns + column)] += 1;
    }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            for (int y = 0; y < 5 * panels; ++y)
                for (int x = 0; x < 5; ++x) {
                    const double cosine = (row + (y / 5 + node[y % 5]) / panels) / rows,
                                 azimuth = 2 * M_PI * ((column + node[x]) / columns - 0.5);
                    expected[size_t(row * columns + column)] += samples * weight[y % 5] / panels * weight[x] * 2 *
                                                                M_PI / (rows * columns) *
                                                                pdf(direction(cosine, azimuth));
                }
    const double above = std::accumulate(expected.begin(), expected.end(), 0.0);
    EXPECT_LT(above, samples * 1.001);  // a density, not more
    expected.back() = std::max(0.0, samples - above);

    // Cells are pooled, in ascending order, until each expects 10 samples.
    std::vector<size_t> order(expected.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::sort(order, {}, [&](size_t i) { return expected[i]; });
    double chi_square = 0, pooled_observed = 0, pooled_expected = 0;
    int cells = 0;
    for (size_t i : order) {
        pooled_observed += observed[i];
        pooled_expected += expected[i];
        if (pooled_expected < 10) continue;
        chi_square += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        pooled_observed = pooled_expected = 0;
        ++cells;
    }
    EXPECT_GT(cells, 30);
    return normal_deviate(chi_square, cells - 1);
}

struct LobeView {
    float alpha, cosine;
};
// The narrowest lobe is left to the furnace tests: its density varies within the cells.
const LobeView lobe_views[] = {{0.1f, 0.25f}, {0.1f, 0.5f},  {0.1f, 1.0f}, {0.25f, 0.05f}, {0.25f, 0.5f}, {0.25f, 0.9f},
                               {0.5f, 0.1f},  {0.5f, 0.75f}, {0.5f, 1.0f}, {1.0f, 0.05f},  {1.0f, 0.5f},  {1.0f, 1.0f}};

}  // namespace

TEST(brdf, samplers_follow_their_densities) {
    for (const auto& [alpha, cosine] : lobe_views) {
        SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", cosine " << cosine);
        const vec3 o = direction(cosine, 0.7);
        EXPECT_LT(chi_square_deviate([&](vec2 u) { return sample_ggx_reflection(o, alpha, u); },
                                     [&](vec3 i) { return ggx_reflection_pdf(o, i, alpha); }, 1),
                  5.2);
        EXPECT_LT(chi_square_deviate([&](vec2 u) { return sample_ggx_reflection_bounded(o, alpha, u); },
                                     [&](vec3 i) { return ggx_reflection_bounded_pdf(o, i, alpha); }, 2),
                  5.2);
    }
    EXPECT_LT(chi_square_deviate([](vec2 u) { return sample_cosine(u); }, [](vec3 i) { return i.z / pi; }, 3), 5.2);
}

TEST(brdf, chi_square_test_has_power) {
    const float alpha = 0.25f;
    const vec3 o = direction(0.5, 0.7);
    const auto sample = [&](vec2 u) { return sample_ggx_reflection(o, alpha, u); };
    // A lobe that is 10 % wider, and the bounded density for unbounded samples.
    EXPECT_GT(chi_square_deviate(
                  sample, [&](vec3 i) { return ggx_reflection_pdf(o, i, 1.1f * alpha); }, 1),
              5.2);
    EXPECT_GT(chi_square_deviate(
                  sample, [&](vec3 i) { return ggx_reflection_bounded_pdf(o, i, alpha); }, 1),
              5.2);
}

TEST(brdf, distribution_is_exact_in_float) {
    for (const double alpha : {1e-3, 2.5e-3, 0.01, 0.04, 0.3, 1.0})
        for (int step = 1; step < 400; ++step) {
            const double angle = M_PI / 2 * std::pow(step / 400.0, 3), azimuth = step;
            const vec3 m = normalize(direction(std::cos(angle), azimuth));
            const float a = float(alpha);
            const double x = m.x, y = m.y, z = m.z, a2 = double(a) * a, t = x * x + y * y + a2 * z * z;
            const double exact = a2 / (M_PI * t * t);
            EXPECT_NEAR(ggx_distribution(m, a), exact, 2e-6 * exact);
        }
}

TEST(brdf, weights_stay_in_range_at_grazing_views) {
    for (const float alpha : {1e-3f, 0.1f, 1.0f})
        for (float mu = 1e-6f; mu < 1; mu *= 2) {
            const vec3 o = direction(mu, 0.3);
            for (uint32_t i = 0; i < 256; ++i) {
                const glm::vec2 u = SobolSequence(5).pair(reverse_bits(i), 0);
                for (const vec3 towards :
                     {sample_ggx_reflection(o, alpha, u), sample_ggx_reflection_bounded(o, alpha, u)}) {
                    ASSERT_NEAR(length(towards), 1, 1e-5);
                    const float weight = ggx_reflection_weight(mu, towards.z, alpha);
                    ASSERT_TRUE(weight >= 0 && weight <= 1.00001f) << weight;
                    ASSERT_TRUE(std::isfinite(ggx_reflection_pdf(o, towards, alpha)));
                }
            }
        }
}

TEST(brdf, lobe_evaluation_agrees_with_the_shared_formulas) {
    const vec3 color(0.9f, 0.5f, 0.2f);
    for (const vec3 f0 : {vec3(0.04f), vec3(0.9f, 0.3f, 0.02f)})  // of the dielectric
        for (const float metalness : {0.0f, 0.3f, 1.0f})
            for (const float roughness : {0.1f, 0.5f, 1.0f}) {
                const vec3 o = direction(0.6, 0), i = direction(0.4, 2.6), m = normalize(o + i);
                const float specular = 0.8f, alpha = ggx_alpha(roughness), w = schlick_weight(dot(o, m));
                const auto lobes_from = [&](vec3 viewer) {
                    constexpr ReflectionModel gltf = ReflectionModel::gltf;
                    return f0 == vec3(0.04f) ? make_lobes(color, metalness, roughness, specular, viewer, gltf)
                                             : make_lobes(color, metalness, roughness, specular, f0, viewer, gltf);
                };
                const LobeValues found = evaluate(lobes_from(o), i), swapped = evaluate(lobes_from(i), o);
                // glTF 2.0, Appendix B, written out; KHR_materials_specular scales the dielectric Fresnel term, and
                // diffuse light lacks the largest of its colours.
                const auto dielectric_of = [&](float reflectance) {
                    return specular * (reflectance + (1 - reflectance) * w);
                };
                const float lost = dielectric_of(std::max({f0.x, f0.y, f0.z})), lobe = ggx_specular(o, i, alpha);
                for (int channel = 0; channel < 3; ++channel) {
                    const float metal = color[channel] + (1 - color[channel]) * w;
                    const float dielectric = dielectric_of(f0[channel]);
                    EXPECT_NEAR(found.diffuse[channel], (1 - metalness) * (1 - lost) * color[channel] / pi * i.z,
                                1e-6f);
                    EXPECT_NEAR(found.specular[channel],
                                ((1 - metalness) * dielectric + metalness * metal) * lobe * i.z, 1e-5f * (1 + lobe));
                    EXPECT_NEAR(found.specular[channel] / i.z, swapped.specular[channel] / o.z,
                                1e-5f * (1 + lobe));  // reciprocity
                }
                EXPECT_NEAR(found.specular_pdf, ggx_reflection_bounded_pdf(o, i, alpha),
                            1e-5f * (1 + found.specular_pdf));
            }
}

TEST(brdf, basis_is_orthonormal_and_right_handed) {
    for (int i = 0; i < 1000; ++i) {
        const vec3 n = direction(std::cos(0.0031415 * i), 2.4 * i);
        const mat3 frame = basis_from_normal(n);
        EXPECT_NEAR(length(cross(frame[0], frame[1]) - frame[2]), 0, 1e-6);
        EXPECT_NEAR(dot(frame[0], frame[1]), 0, 1e-6);
        EXPECT_EQ(frame[2], n);
    }
}

TEST(brdf, unit_circle_is_exact_in_float) {
    for (int i = 0; i <= 4096; ++i) {
        const vec2 found = unit_circle(float(i) / 4096);
        EXPECT_NEAR(found.x, std::cos(2 * M_PI * i / 4096), 1.5e-7);
        EXPECT_NEAR(found.y, std::sin(2 * M_PI * i / 4096), 1.5e-7);
    }
}

TEST(golden_brdf, sampled_albedo_and_first_moments) {
    const nlohmann::json table = golden_table("ggx_albedo"), moments = table["first_moments"];
    const uint32_t samples = 1 << 14;
    for (size_t row = 0; row < table["alpha"].size(); ++row)
        for (size_t column = 0; column < table["cosTheta"].size(); ++column) {
            const float alpha = table["alpha"][row], mu = table["cosTheta"][column];
            const vec3 o = direction(mu, 0);
            double albedo = 0, tangential = 0, normal = 0;
            for (uint32_t i = 0; i < samples; ++i) {
                const vec3 towards = sample_ggx_reflection(o, alpha, SobolSequence(1).pair(reverse_bits(i), 0));
                const double weight = ggx_reflection_weight(mu, towards.z, alpha);
                albedo += weight / samples;
                tangential -= weight * towards.x / samples;
                normal += weight * towards.z / samples;
            }
            SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", cosine " << mu);
            // 2^14 points of a (0, 2)-sequence: the integrand jumps at the horizon, so the error falls like N^-3/4,
            // 7e-4.
            EXPECT_NEAR(albedo, double(table["E"][row][column]), 7e-4);
            EXPECT_NEAR(tangential, double(moments["Mt"][row][column]), 7e-4);
            EXPECT_NEAR(normal, double(moments["Mz"][row][column]), 7e-4);
        }
}

TEST(golden_split_sum, integral) {
    const nlohmann::json table = golden_table("brdf_lut");
    for (const nlohmann::json& each : {table, table["dense"]})
        for (size_t row = 0; row < each["perceptualRoughness"].size(); ++row)
            for (size_t column = 0; column < each["cosTheta"].size(); ++column) {
                const double roughness = each["perceptualRoughness"][row];
                const glm::dvec2 found = split_sum(each["cosTheta"][column], roughness * roughness);
                EXPECT_NEAR(found.x, double(each["A"][row][column]), 5e-5) << roughness;
                EXPECT_NEAR(found.y, double(each["B"][row][column]), 5e-5) << roughness;
            }
}

TEST(golden_split_sum, table) {
    const HostImage table = split_sum_table();
    const auto size = float(table.extent.x);
    const auto texel = [&](int x, int y) {
        const float* value =
            table.pixel(unsigned(std::clamp(x, 0, int(size) - 1)), unsigned(std::clamp(y, 0, int(size) - 1)));
        return glm::dvec2(value[0], value[1]);
    };
    const nlohmann::json dense = golden_table("brdf_lut")["dense"];
    for (size_t row = 0; row < dense["perceptualRoughness"].size(); ++row)
        for (size_t column = 0; column < dense["cosTheta"].size(); ++column) {
            const float y = float(dense["perceptualRoughness"][row]) * size - 0.5f,
                        x = float(dense["cosTheta"][column]) * size - 0.5f;
            const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
            const glm::dvec2 found = glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), double(x - float(x0))),
                                              glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), double(x - float(x0))),
                                              double(y - float(y0)));
            // Bilinear interpolation misses half the second derivative times (1/128)^2, which is large at grazing views
            // only.
            const double tolerance = double(dense["cosTheta"][column]) < 0.1 ? 6e-3 : 1e-3;
            EXPECT_NEAR(found.x, double(dense["A"][row][column]), tolerance);
            EXPECT_NEAR(found.y, double(dense["B"][row][column]), tolerance);
        }
}
