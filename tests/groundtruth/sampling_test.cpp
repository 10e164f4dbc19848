#include "core/shared/environment.h"
#include "groundtruth/lights/environment_table.h"
#include "groundtruth/lights/light_clusters.h"
#include "groundtruth/paths/traced_scene.h"
#include "groundtruth/sampling/alias_table.h"
#include "groundtruth/sampling/sobol.h"
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <cmath>
#include <set>

namespace {

/// The second Sobol' dimension by its recurrence (Kollig and Keller 2002), the slow way.
uint32_t sobol_y(uint32_t index) {
    uint32_t y = 0;
    for (uint32_t direction = 1u << 31; index; index >>= 1, direction ^= direction >> 1)
        if (index & 1) y ^= direction;
    return y;
}

}  // namespace

TEST(sobol, folds_equal_the_recurrence) {
    for (uint32_t i = 0; i < 2000; ++i)
        for (const uint32_t index : {i, hash_bits(i)}) ASSERT_EQ(reverse_bits(reversed_sobol_y(index)), sobol_y(index));
}

TEST(sobol, every_elementary_interval_holds_one_point) {
    // 2^k points of a (0, 2)-sequence put exactly one into each box of 2^-a by 2^-(k - a), scrambled or not.
    const unsigned k = 8;
    for (const uint64_t seed : {1ull, 2ull, 0xdeadbeefull})
        for (const uint32_t pair : {0u, 1u, 70000u})
            for (const uint32_t first : {0u, 256u, 512u * 77})
                for (unsigned a = 0; a <= k; ++a) {
                    std::set<uint32_t> boxes;
                    for (uint32_t i = first; i < first + (1u << k); ++i) {
                        const glm::uvec2 bits = SobolSequence(seed).bits(reverse_bits(i), pair);
                        const uint32_t x = a ? bits.x >> (32 - a) : 0, y = a < k ? bits.y >> (32 - (k - a)) : 0;
                        boxes.insert(x << (k - a) | y);
                    }
                    ASSERT_EQ(boxes.size(), 1u << k);
                }
}

TEST(sobol, scrambles_are_uniform_and_independent) {
    // Over 20000 seeds the first point is uniform: chi-square over 16 x 16 cells has 255 degrees of freedom, standard
    // deviation 22.6; 6 of them (p = 1e-8 by the normal approximation).
    const int seeds = 20000;
    std::vector<double> count(256, 0.0);
    double correlation = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        const SobolSequence sequence{uint64_t(seed)};
        const glm::vec2 a = sequence.pair(0, 3), b = sequence.pair(0, 4);
        count[size_t(a.x * 16) * 16 + size_t(a.y * 16)] += 1;
        correlation += (a.x - 0.5) * (b.x - 0.5) * 12 / seeds;
    }
    double chi_square = 0;
    for (double each : count) chi_square += (each - seeds / 256.0) * (each - seeds / 256.0) / (seeds / 256.0);
    EXPECT_NEAR(chi_square, 255, 6 * 22.6);
    EXPECT_NEAR(correlation, 0, 6 / std::sqrt(seeds));
}

TEST(sobol, integrates_smooth_functions_faster_than_random_numbers) {
    const auto error = [](bool random) {
        double squares = 0;
        for (uint64_t seed = 0; seed < 64; ++seed) {
            double sum = 0;
            for (uint32_t i = 0; i < 256; ++i) {
                const SobolSequence sequence(seed);
                const glm::vec2 u =
                    random ? glm::vec2(sequence.random(reverse_bits(i), 0), sequence.random(reverse_bits(i), 1))
                           : sequence.pair(reverse_bits(i), 0);
                sum += std::exp(u.x) * u.y / 256;
            }
            squares += (sum - (M_E - 1) / 2) * (sum - (M_E - 1) / 2) / 64;
        }
        return squares;
    };
    EXPECT_LT(error(false), 1e-3 * error(true));  // N^-3 against N^-1 in variance: 1.5e-5 of it, with constants
}

TEST(alias_table, draws_by_weight_and_hands_back_a_uniform_number) {
    const std::vector<double> weights = {1, 0, 3, 0.5, 10, 0, 2};
    const AliasTable table(weights);
    std::vector<double> count(weights.size(), 0.0), rest(weights.size(), 0.0);
    const uint32_t samples = 1 << 20;
    for (uint32_t i = 0; i < samples; ++i) {
        const AliasTable::Choice choice = table.sample(i << 12);
        count[choice.index] += 1;
        rest[choice.index] += choice.rest * 0x1p-32;
    }
    for (size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(table.probability(i), weights[i] / 16.5, 1e-12);
        EXPECT_NEAR(count[i] / samples, weights[i] / 16.5, 1e-5);  // an even grid of numbers: one step per slot edge
        if (count[i] == 0) continue;
        EXPECT_NEAR(rest[i] / count[i], 0.5, 1e-3);
    }
    EXPECT_TRUE(AliasTable(std::vector<double>(3, 0.0)).empty());
    EXPECT_EQ(AliasTable(std::vector<double>{0, 5}).sample(0).index, 1u);
}

TEST(light_choice, draws_groups_with_the_probabilities_that_it_states) {
    LightChoice choice(std::vector<double>(3, 1.0 / 3));
    std::vector<LightObservation> seen;  // group 1 is all that arrives at the floor, group 2 at the ceiling
    for (int i = 0; i < 300; ++i) {
        const uint32_t group = uint32_t(i % 3);
        seen.push_back({vec3(0.1f), vec3(0, 1, 0), group, 0, group == 1 ? 2.0f : 0.0f});
        seen.push_back({vec3(0.1f), vec3(0, -1, 0), group, 0, group == 2 ? 6.0f : 0.0f});
    }
    const LearningGrid grid(vec3(-1), vec3(1));
    choice.learn(seen, grid);
    const auto cell = [&](vec3 at, vec3 normal) { return choice.cell(grid.index(at, normal)); };
    const uint32_t floor = cell(vec3(0.1f), vec3(0.1f, 0.9f, 0.2f)), ceiling = cell(vec3(0.1f), vec3(0, -1, 0));
    const uint32_t unseen = cell(vec3(0.9f), vec3(1, 0, 0));
    EXPECT_GT(choice.probability(floor, 1), 0.8f);
    EXPECT_GT(choice.probability(ceiling, 2), 0.8f);
    EXPECT_EQ(unseen, 0u);  // the whole scene, where group 2 brings three times as much as group 1
    EXPECT_NEAR(choice.probability(0, 2), 0.1 / 3 + 0.9 * 0.75, 1e-6);
    for (const uint32_t cell : {floor, ceiling, unseen}) {
        const int samples = 1 << 16;
        double total = 0, count[3] = {}, rest[3] = {};
        for (uint32_t i = 0; i < samples; ++i) {
            const LightChoice::Choice chosen = choice.sample(cell, i << 16);
            count[chosen.group] += 1;
            rest[chosen.group] += chosen.rest * 0x1p-32;
        }
        for (uint32_t g = 0; g < 3; ++g) {
            total += choice.probability(cell, g);
            EXPECT_GE(choice.probability(cell, g), 0.033f);  // a third of the share of 0.1 that is not learnt
            EXPECT_NEAR(count[g] / samples, choice.probability(cell, g), 1.0 / samples);  // an even grid of numbers
            EXPECT_NEAR(rest[g] / count[g], 0.5, 1e-3);
        }
        EXPECT_EQ(total, 1.0);
        EXPECT_EQ(choice.sample(cell, ~0u).group, 2u);
    }
}

TEST(light_clusters, draw_lights_with_the_probabilities_that_they_state) {
    std::vector<LightExtent> lights;
    for (int i = 0; i < 60; ++i) {
        const float turn = 0.1f * float(i);
        lights.push_back({.center = {std::cos(turn), 0.02f * float(i), std::sin(turn)},
                          .normal = i % 3 ? vec3(0, i % 3 == 1 ? 1 : -1, 0) : vec3(0),
                          .square_radius = 1e-4f,
                          .power = 1.0 + i % 7});
    }
    const LightClusters clusters(lights);
    const uint32_t samples = 1 << 18;
    // Near, far, on a light, where squares overflow, and no number.
    for (const vec3 point : {vec3(0.5f), vec3(9, -4, 2), lights[7].center, vec3(1e25f), vec3(NAN)}) {
        std::vector<double> count(lights.size(), 0.0), rest(lights.size(), 0.0);
        for (uint32_t i = 0; i < samples; ++i) {
            const LightClusters::Choice choice = clusters.sample(point, i << 14);
            ASSERT_EQ(choice.probability, clusters.probability(choice.light, point));
            count[choice.light] += 1, rest[choice.light] += choice.rest * 0x1p-32;
        }
        double total = 0;
        for (uint32_t light = 0; light < lights.size(); ++light) {
            const double probability = clusters.probability(light, point);
            total += probability;
            EXPECT_GT(probability, 0);
            // An even grid of numbers: a light has two parts of its cluster's table, each wrong by a step at most.
            EXPECT_NEAR(count[light], probability * samples, 3);
            EXPECT_NEAR(rest[light], 0.5 * count[light], 3);
        }
        EXPECT_NEAR(total, 1, 1e-5);  // roundings of 60 float32 quotients, with room
    }
    EXPECT_EQ(clusters.sample(vec3(0), ~0u).probability,
              clusters.probability(clusters.sample(vec3(0), ~0u).light, vec3(0)));
}

TEST(light_clusters, follow_distance_and_facing) {
    const auto lamp = [](vec3 at, vec3 normal) {
        return LightExtent{.center = at, .normal = normal, .square_radius = 1e-12f, .power = 3};
    };
    // At three times the distance a ninth of the irradiance. 1e-5 here and below: some ten roundings of float32, and a
    // radius of 1e-6 of the distance.
    const LightClusters two(std::vector{lamp({0, 1, 0}, vec3(0)), lamp({0, -3, 0}, vec3(0))});
    EXPECT_NEAR(two.probability(0, vec3(0)), 0.9, 1e-5);
    // Under 60 degrees half of it; from behind what is kept for lights that a cluster hides.
    const LightClusters facing(std::vector{lamp({0, 1, 0}, {0, -1, 0}), lamp({0, -1, 0}, {std::sqrt(0.75f), 0.5f, 0}),
                                           lamp({1, 0, 0}, {1, 0, 0})});
    EXPECT_NEAR(facing.probability(1, vec3(0)) / facing.probability(0, vec3(0)), 0.5, 1e-5);
    EXPECT_NEAR(facing.probability(2, vec3(0)) / facing.probability(0, vec3(0)), 0.1, 1e-5);
}

TEST(environment_table, density_integrates_to_one_and_is_that_of_the_samples) {
    Environment sky{.type = Environment::Type::image, .latlong = HostImage({48, 24}, 3, 0.1f), .rotation = 0.7f};
    for (int channel = 0; channel < 3; ++channel)
        sky.latlong.pixel(30, 6)[channel] = 50, sky.latlong.pixel(5, 23)[channel] = 9;
    for (const bool compensate : {false, true}) {
        const EnvironmentTable table(sky, compensate);
        ASSERT_GT(table.part_count(), 1u);
        std::vector<double> integral(table.part_count(), 0.0);
        double light = 0, sampled_light = 0;
        const int rows = 480, columns = 960;
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const glm::vec3 d =
                    environment_direction({(column + 0.5f) / columns, (row + 0.5f) / rows}, sky.rotation);
                const double solid_angle =
                    2 * M_PI / columns * (std::cos(M_PI * row / rows) - std::cos(M_PI * (row + 1) / rows));
                const EnvironmentTable::Density density = table.density(table.place(d));
                integral[density.part] += density.pdf * solid_angle;
                if (density.pdf > 0) light += sky.radiance(d).x * solid_angle;
            }
        for (const double part : integral) EXPECT_NEAR(part, 1, 1e-4);
        const uint32_t samples = 1 << 16;
        for (uint32_t i = 0; i < samples; ++i) {
            float pdf;
            const uint32_t part = i % table.part_count();
            const glm::uvec2 bits = SobolSequence(3).bits(reverse_bits(i / table.part_count()), 0);
            const glm::vec2 place = table.place(part, table.choose(part, bits), bits, pdf);
            const glm::vec3 d = table.direction(place);
            ASSERT_GT(pdf, 0);
            ASSERT_NEAR(glm::length(d), 1, 1e-5);
            if (i % 64 == 0) {
                EXPECT_EQ(table.density(table.place(d)).part, part) << i;  // but at the very edge of a cell
                EXPECT_NEAR(table.density(table.place(d)).pdf, pdf, 0.2 * pdf) << i;
            }
            EXPECT_NEAR(table.radiance(place, d).x, sky.radiance(d).x, 1e-3f * (1 + sky.radiance(d).x))
                << i;  // rounding
            sampled_light += sky.radiance(d).x / pdf / samples * table.part_count();
        }
        EXPECT_NEAR(sampled_light, light, 5e-3 * light);
    }
}

TEST(light_sampler, densities_are_those_of_the_surfaces_that_rays_meet) {
    TestScene scene;
    scene.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, scene.add(lambert_material(0, 3)));
    scene.sphere({3, 1, 0}, 0.5f, 8, scene.add(lambert_material(0, 8)));
    TracedScene traced(scene.scene, scene.pose(), CameraView({}, {1, 1}), {});
    const uint32_t samples = 1 << 14;
    LanesVec3 point;
    Lanes<uint32_t> wanted, x, y;
    LightLanes lights;
    std::vector<LightObservation> seen;
    // By power; then as they are learnt from the light that arrives, with clusters of the ball's facets.
    double solid_angles[2] = {}, variances[2] = {};
    for (const bool is_learnt : {false, true}) {
        double solid_angle = 0, squares = 0, light = 0;
        for (uint32_t first = 0; first < samples; first += lane_count) {
            for (int lane = 0; lane < lane_count; ++lane) {
                const glm::uvec2 bits = SobolSequence(8).bits(reverse_bits(first + uint32_t(lane)), 0);
                x[lane] = bits.x, y[lane] = bits.y, wanted[lane] = 1;
                point.set(lane, vec3(0));
            }
            const uint32_t cell = traced.lights.choice().cell(traced.lights.grid().index(vec3(0), vec3(0, 1, 0)));
            Lanes<uint32_t> cells;
            std::ranges::fill(cells.value, cell);
            traced.lights.sample(wanted, point, cells, x, y, lights);
            for (int lane = 0; lane < lane_count; ++lane) {
                const vec3 direction = lights.direction.get(lane);
                const float arriving =
                    lights.pdf[lane] > 0 ? lights.radiance.get(lane).x * std::max(direction.y, 0.0f) / lights.pdf[lane]
                                         : 0.0f;
                light += double(arriving) / samples, squares += double(arriving) * double(arriving) / samples;
                if (!is_learnt)
                    seen.push_back(
                        {vec3(0), vec3(0, 1, 0), lights.group[lane], lights.light[lane], arriving, arriving});
                if (lights.pdf[lane] == 0) continue;  // the far side of the ball
                RTCRayHit ray;
                if (!intersect(traced.geometry.handle(), vec3(0), direction, ray))
                    continue;  // past a facet seen edge-on
                const vec3 normal =
                    traced.geometry.point(ray.hit.instID[0], ray.hit.primID, ray.hit.u, ray.hit.v).front_normal;
                const float pdf = traced.lights.triangle_pdf(cell, vec3(0), ray.hit.instID[0], ray.hit.primID, normal,
                                                             direction, ray.ray.tfar);
                // A ray along a shared edge may meet the neighbour, whose density is another.
                if (std::abs(pdf - lights.pdf[lane]) < 1e-3f * pdf) solid_angle += 1.0 / pdf / samples;
            }
        }
        solid_angles[is_learnt] = solid_angle;
        variances[is_learnt] = squares - light * light;
        if (!is_learnt) traced.lights.learn(seen, true);
    }
    const glm::dvec3 origin(0);
    // The integral of 1 over directions: the solid angle of the rectangle and of the ball, a polyhedron in its sphere.
    const double rectangle = 4 * std::asin(1 * 1 / ((1 + 4.0) * 1)), ball = 2 * M_PI * (1 - std::sqrt(1 - 0.25 / 10));
    for (const double solid_angle : solid_angles) EXPECT_NEAR(solid_angle, rectangle + ball, 0.01);
    EXPECT_LT(variances[1], 0.5 * variances[0]);  // it decides
    EXPECT_EQ(traced.lights.has_environment_table(), false);
}
