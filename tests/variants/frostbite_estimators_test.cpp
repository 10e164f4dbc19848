#include "tests/variants/frostbite_bench.h"
#include "tests/variants/frostbite_emitter.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

// The bias of the three estimators on the one-emitter case, of the formulas and of the shader, against quadrature.

namespace {

struct Reported {
    EmitterCase scene;
    unsigned lobe;
    double a1, a4, a16, c;  ///< percent, of the fact sheet; 0 where it is silent
};

/// Frostbite's fact sheet, section 1.6: measured with other random numbers, given in whole percent or tenths.
const Reported reported[] = {{{0.3f, 60}, lobe_of_visible_normals, 0, 0, 0, -1},
                             {{0.5f, 60}, lobe_of_normals, -19, -2.7, -0.7, 0},
                             {{0.5f, 60}, lobe_of_visible_normals, -6, -1, -0.4, -6},
                             {{0.5f, 75}, lobe_of_normals, -32, -6.7, -0.6, 0},
                             {{0.5f, 75}, lobe_of_visible_normals, -8, -1, -0.1, -8}};

struct Measured {
    double mean, standard_error;
};

Measured measured(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / double(values.size());
    for (const double v : values) squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / double(values.size() - 1) / double(values.size()))};
}

/// 5 standard errors: for the 24 or more values of each mean a false alarm in 40000, for all means of this file
/// together one in 500; the random numbers are the same in every run. Quadrature cuts the emitter's rim into cells of a
/// degree: 0.2 %.
void expect_bias(const std::vector<double>& values, double truth, double bias, const std::string& what) {
    const Measured found = measured(values);
    EXPECT_LT(found.standard_error, 0.03 * truth) << what;  // or the test says little
    EXPECT_NEAR(found.mean / truth - 1, bias, 5 * found.standard_error / truth + 0.002) << what;
}

std::string name_of(const EmitterCase& scene, unsigned lobe) {
    return "roughness " + std::to_string(scene.roughness) + ", view " + std::to_string(scene.view_degrees) +
           (lobe == lobe_of_normals ? ", normals" : ", visible normals");
}

/// The floor of an orthographic camera: every pixel sees it from the same direction.
struct EmitterBench {
    static constexpr glm::uvec2 extent{64, 64};
    static constexpr unsigned border = 5;  ///< pixels, whose taps would be fewer
    EmitterCase scene;
    FrostbiteBench bench;
    HostImage color{extent, 4};

    EmitterBench(Device& device, const EmitterCase& emitter, const nlohmann::json& parameters)
        : scene(emitter), bench(device, pose(), {.extent = extent}, floor(), parameters) {
        for (size_t i = 0; i < color.pixel_count(); ++i) color.set_rgb(i, glm::vec3(emitter.other_radiance));
        color.set_rgb(0, glm::vec3(emitter.emitter_radiance));
    }

    CameraPose pose() const {
        const float down = glm::radians(90 - scene.view_degrees);
        const glm::mat4 up = glm::translate(glm::mat4(1), glm::vec3(0, 5, 0));
        return {.world_from_view = glm::rotate(up, -down, glm::vec3(1, 0, 0)),
                .is_orthographic = true,
                .orthographic_height = 2};
    }

    SyntheticScene floor() const {
        return [roughness = scene.roughness](const CameraRay& ray) {
            return SyntheticHit{.distance = -ray.origin.y / ray.direction.y,
                                .normal = {0, 1, 0},
                                .roughness = roughness,
                                .metalness = 1,
                                .specular = 1};
        };
    }

    /// From the frame of EmitterCase, whose x axis is in the plane of view and normal.
    glm::mat3 view_from_local() const {
        const glm::vec3 n = glm::mat3(bench.camera.view_from_world) * glm::vec3(0, 1, 0), o(0, 0, 1);
        const glm::vec3 x = normalize(o - n * dot(n, o));
        return {x, cross(n, x), n};
    }

    /// `factor`: of the lobe's inverse density, for rays that are drawn again.
    std::vector<StoredRay> draw(unsigned lobe, unsigned regenerations, float factor, std::mt19937& random) {
        std::vector<StoredRay> rays(size_t(extent.x) * extent.y * unsigned(bench.ray_parameters.max_rays));
        const glm::mat3 to_view = view_from_local();
        for (StoredRay& ray : rays) {
            const DrawnRay drawn = draw_ray(scene, lobe, bench.ray_parameters.importance_bias, regenerations, random);
            const unsigned other_pixel = 1, emitter_pixel = 0;
            ray = {.direction = to_view * drawn.direction,
                   .inverse_density = factor * drawn.inverse_density,
                   .target = drawn.is_below_horizon              ? ray_below_horizon
                             : scene.is_emitter(drawn.direction) ? emitter_pixel
                                                                 : other_pixel,
                   .length = 1};
        }
        return rays;
    }

    /// Mean radiance times confidence, which is what is composited, over the pixels that have all their taps.
    double resolve(const std::vector<StoredRay>& rays) {
        const HostImage radiance = bench.resolve(rays, color).radiance;
        double sum = 0;
        for (unsigned y = border; y < extent.y - border; ++y)
            for (unsigned x = border; x < extent.x - border; ++x)
                sum += double(radiance.pixel(x, y)[0]) * radiance.pixel(x, y)[3];
        return sum / ((extent.x - 2 * border) * (extent.y - 2 * border));
    }

    /// One mean for each of many seeds.
    std::vector<double> means(unsigned lobe, unsigned regenerations) {
        std::vector<double> result;
        std::mt19937 random(1);
        const EmitterTruth truth = emitter_truth(scene, lobe, bench.ray_parameters.importance_bias);
        const float factor = float(redrawn_factor(truth, regenerations));  // by quadrature
        for (unsigned seed = 0; seed < 24; ++seed) {
            bench.set_frame(seed, seed);
            result.push_back(resolve(draw(lobe, regenerations, factor, random)));
        }
        return result;
    }
};

nlohmann::json own_rays(unsigned lobe) {
    return {{"half_resolution", false},    {"importance_bias", 0.0},
            {"filtered_sampling", false},  {"previous_frame", false},
            {"neighbor_ray", "direction"}, {"lobe", lobe == lobe_of_normals ? "normals" : "visible_normals"}};
}

std::vector<double> shader_means(Device& device, const Reported& r, unsigned regenerations,
                                 const nlohmann::json& overrides) {
    nlohmann::json parameters = own_rays(r.lobe);
    parameters["max_regenerations"] = regenerations;
    parameters.update(overrides);
    return EmitterBench(device, r.scene, parameters).means(r.lobe, regenerations);
}

struct FrostbiteEstimators : TechniqueTest {};

TEST_F(FrostbiteEstimators, HaveTheBiasOfTheFactSheet) {
    for (const Reported& r : reported) {
        const EmitterTruth truth = emitter_truth(r.scene, r.lobe);
        const std::string what = name_of(r.scene, r.lobe);
        // The sheet's own noise: of N = 1 less than a percent, of its differences from zero about half a percent.
        if (r.a1 != 0) {
            EXPECT_NEAR(100 * bias_of_a(truth, 1), r.a1, 1) << what;
        }
        if (r.a4 != 0) {
            EXPECT_NEAR(100 * bias_of_a(truth, 4), r.a4, 0.7) << what;
        }
        if (r.a16 != 0) {
            EXPECT_NEAR(100 * bias_of_a(truth, 16), r.a16, 0.4) << what;
        }
        if (r.c != 0) {
            EXPECT_NEAR(100 * bias_of_c(truth), r.c, 0.5) << what;
        }
        if (r.lobe == lobe_of_normals) continue;
        const double dropped = r.scene.roughness == 0.3f ? 1 : 7;
        // Rays that keep the density of the lobe, however often they were drawn.
        EXPECT_NEAR(100 * (1 / redrawn_factor(truth, 4) - 1), dropped, 0.6) << what;
    }
}

TEST_F(FrostbiteEstimators, OfDrawnRaysHaveTheBiasOfQuadrature) {
    std::mt19937 random(3);
    for (const Reported& r : reported) {
        const EmitterTruth truth = emitter_truth(r.scene, r.lobe);
        const glm::vec3 o = r.scene.o();
        for (const unsigned rays : {1u, 4u, 16u}) {
            std::vector<double> a, c;
            for (unsigned repeat = 0; repeat < 400000 / rays; ++repeat) {
                double weights = 0, weighed = 0, radiance = 0;
                for (unsigned k = 0; k < rays; ++k) {
                    const DrawnRay ray = draw_ray(r.scene, r.lobe, 0, 16, random);
                    const double weight =
                        ggx_specular(o, ray.direction, r.scene.alpha()) * ray.direction.z * ray.inverse_density;
                    weights += weight;
                    weighed += weight * r.scene.radiance(ray.direction);
                    radiance += r.scene.radiance(ray.direction);
                }
                a.push_back(weighed / weights);
                c.push_back(radiance / rays);
            }
            const std::string what = name_of(r.scene, r.lobe) + ", rays " + std::to_string(rays);
            expect_bias(a, truth.mean(), bias_of_a(truth, rays), "a, " + what);
            expect_bias(c, truth.mean(), bias_of_c(truth), "c, " + what);
        }
    }
}

TEST_F(FrostbiteEstimators, OfTheShaderHaveTheBiasOfQuadrature) {
    for (const Reported& r : reported) {
        const EmitterTruth truth = emitter_truth(r.scene, r.lobe);
        const std::string what = name_of(r.scene, r.lobe);
        const double mean = truth.mean();
        const auto means = [&](const nlohmann::json& overrides) { return shader_means(device(), r, 16, overrides); };
        expect_bias(means({{"taps", "1"}}), mean, bias_of_a(truth, 1), "a, 1 tap, " + what);
        expect_bias(means({{"taps", "4"}}), mean, bias_of_a(truth, 4), "a, 4 taps, " + what);
        expect_bias(means({{"taps", "16"}}), mean, bias_of_a(truth, 16), "a, 16 taps, " + what);
        expect_bias(means({{"taps", "1"}, {"max_rays", 4}}), mean, bias_of_a(truth, 4), "a, 4 rays, " + what);
        expect_bias(means({{"taps", "4"}, {"estimator", "c"}}), mean, bias_of_c(truth), "c, 4 taps, " + what);
    }
}

TEST_F(FrostbiteEstimators, BIsUnbiasedWhereTheLobeBelowTheHorizonCounts) {
    for (const Reported& r : reported) {
        const EmitterTruth truth = emitter_truth(r.scene, r.lobe);
        const std::string what = name_of(r.scene, r.lobe);
        const auto means = [&](unsigned regenerations, const nlohmann::json& overrides) {
            nlohmann::json parameters = {{"estimator", "b"}, {"reflectance_after_filter", false}};
            parameters.update(overrides);
            return shader_means(device(), r, regenerations, parameters);
        };
        // Without regenerations the sum of q / p over own rays is their number: plain Monte Carlo.
        expect_bias(means(0, {{"taps", "1"}}), truth.reflected, 0, "1 tap, " + what);
        expect_bias(means(0, {{"taps", "4"}}), truth.reflected, 0, "4 taps, " + what);
        for (const unsigned regenerations : {1u, 4u})
            expect_bias(means(regenerations, {{"taps", "4"}}), truth.reflected, bias_of_b(truth, 4, regenerations),
                        "drawn again, " + what);
        // Before the BRDF the table of its integral divides, whose error is below 1e-3: within the tolerance.
        expect_bias(means(0, {{"taps", "4"}, {"reflectance_after_filter", true}}), truth.mean(), 0,
                    "before the BRDF, " + what);
    }
}

/// b's second sum then estimates the part of the lobe that truncation leaves, and what of that is below the horizon has
/// the same scale. With normals seen at 75 degrees that is 14 % of the draws: were it counted as of the whole lobe,
/// twice as much, the mean would be 12 % too small. (Of visible normals truncation leaves next to nothing there.)
TEST_F(FrostbiteEstimators, BCountsWhatTruncationLeavesBelowTheHorizon) {
    const Reported r{{0.5f, 75}, lobe_of_normals, 0, 0, 0, 0};
    const float bias = 0.5f;
    const EmitterTruth truth = emitter_truth(r.scene, r.lobe, bias);
    EXPECT_GT(truth.below_horizon, 0.1);
    const std::vector<double> means = shader_means(
        device(), r, 4,
        {{"estimator", "b"}, {"taps", "4"}, {"reflectance_after_filter", false}, {"importance_bias", bias}});
    expect_bias(means, truth.reflected / (1 - bias), bias_of_b(truth, 4, 4), "truncated, " + name_of(r.scene, r.lobe));
}

}  // namespace
