#include "core/shared/brdf.h"
#include "tests/groundtruth/test_scene.h"
#include "tests/groundtruth/vectors.h"

#include <gtest/gtest.h>
#include <cmath>

// Scenes whose radiance has a closed form, rendered by the real path tracer. Each of the 60 or so comparisons allows 6
// standard errors of 16 batches (Student's t with 15 degrees of freedom: p = 2.4e-5, so 0.2 % of all choices of seeds
// would fail a correct tracer somewhere; the seeds are fixed) plus what the scene deviates from the ideal one, as
// stated.

namespace {

const glm::vec3 up(0, 1, 0);

void expect_mean(const Moments& found, double exact, double deviation) {
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(found.mean[channel], exact, 6 * found.standard_error[channel] + deviation);
        // A comparison that allows anything proves nothing.
        EXPECT_LT(found.standard_error[channel], 0.01 * std::abs(exact) + 1e-9);
    }
}

/// A lobe may lose its energy in rare samples below the horizon, which even 16 batches together may miss, so that their
/// spread does not show: as many losses as a Poisson distribution allows at 6 standard deviations, each at most 1.
double rare_losses(double albedo, unsigned samples_per_batch) {
    const double samples = double(batch_count) * samples_per_batch, expected = (1 - albedo) * samples;
    return expected < 100 ? 6 * std::sqrt(expected) / samples : 0.0;
}

void add_floor(TestScene& scene, unsigned material, float half = 1.0f) {
    scene.quad({-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}, material);
}

double analytic(const std::string& name) { return golden_table("analytic_cases")[name]["value"]; }

}  // namespace

TEST(golden_closed_forms, diffuse_enclosure) {  // 1
    TestScene scene;
    scene.room(glm::vec3(-1), glm::vec3(1), scene.add(lambert_material(0.5f, 0.5f)));
    const CameraPose camera = looking_along({0.2f, 0.1f, 0.3f}, {0.3f, -0.5f, -1.0f});
    for (const ReflectionModel model : {ReflectionModel::gltf, ReflectionModel::lambert}) {
        expect_mean(render(scene, camera, 1024, {.model = model}).diffuse, analytic("diffuse_enclosure_Le0.5_rho0.5"),
                    1e-6);
        // Without light samples and roulette each path adds the same geometric series.
        const PathTracerSettings exact{
            .max_depth = 8, .strategy = LightStrategy::bsdf_only, .russian_roulette = false, .model = model};
        const double truncated = golden_table("analytic_cases")["diffuse_enclosure_Le0.5_rho0.5"]["truncated_depth8"];
        EXPECT_NEAR(render(scene, camera, 16, exact).diffuse.mean.x, truncated, 1e-6);
    }
    PathTracerSettings truncated{.max_depth = 8};
    expect_mean(render(scene, camera, 1024, truncated).diffuse, 1 - std::pow(0.5, 9), 1e-6);
}

TEST(golden_closed_forms, ggx_white_furnace) {  // 2, 14
    const nlohmann::json table = golden_table("ggx_albedo");
    for (size_t row = 0; row < table["alpha"].size(); ++row)
        for (size_t column = 0; column < table["cosTheta"].size(); ++column) {
            const float alpha = table["alpha"][row], cosine = table["cosTheta"][column];
            TestScene scene;
            scene.scene.environment.color = glm::vec3(1.0f);
            add_floor(scene, scene.add(metal_material(1.0f, std::sqrt(alpha))));
            SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", cosine " << cosine);
            const PixelMoments pixel = render(scene, looking_at_origin(up, {1, 0, 0}, cosine), 2048);
            // The viewer's cosine is a float: 1e-7 of it is 2e-6 of itself at 0.05, and E rises at most so steeply.
            const double albedo = table["E"][row][column];
            expect_mean(pixel.specular, albedo, 4e-6 + rare_losses(albedo, 2048));
            EXPECT_EQ(pixel.incident.mean, glm::dvec3(1.0));
            EXPECT_EQ(pixel.diffuse.mean, glm::dvec3(0.0));
        }
    EXPECT_NEAR(double(table["E"].back().back()), analytic("ggx_alpha1_normal_albedo"), 1e-8);
}

/// A mirror of black dielectric below a white sky shows F0 = ((n - 1) / (n + 1))^2 from straight above, and all of the
/// sky at grazing angles, whatever its index of refraction n is.
TEST(golden_closed_forms, dielectrics_reflect_by_their_index_of_refraction) {
    for (const float f0 : {0.0201f, 0.04f, 0.1724f, 1.0f}) {  // n = 1.33, 1.5, 2.42, infinite
        TestScene scene;
        scene.scene.environment.color = glm::vec3(1.0f);
        add_floor(scene, scene.add({.base_color = glm::vec3(0.0f),
                                    .metalness = 0.0f,
                                    .roughness = 0.0f,
                                    .specular_color = {1.0f, 0.5f, 0.0f},
                                    .dielectric_f0 = f0}));
        for (const float cosine : {1.0f, 0.1f}) {
            const PixelMoments pixel = render(scene, looking_at_origin(up, {1, 0, 0}, cosine), 512);
            const double w = std::pow(1.0 - cosine, 5);
            for (int c = 0; c < 3; ++c) {
                const double own = f0 * std::array{1.0, 0.5, 0.0}[size_t(c)];
                // alpha is 1e-3, not 0: at a cosine of 0.1 the lobe's width moves Fresnel's term by some 1e-4.
                EXPECT_NEAR(pixel.specular.mean[c], own + (1 - own) * w, 1e-3) << f0 << ", " << cosine;
            }
            EXPECT_EQ(pixel.diffuse.mean, glm::dvec3(0.0));
        }
    }
}

TEST(golden_closed_forms, dielectric_and_metal_furnace) {  // 3
    const nlohmann::json table = golden_table("brdf_lut"), furnace = table["gltf_dielectric_furnace"];
    for (size_t row = 0; row < table["perceptualRoughness"].size(); ++row) {
        const float roughness = table["perceptualRoughness"][row];
        if (roughness * roughness < min_ggx_alpha) continue;  // neither renderer has so narrow a lobe
        for (size_t column = 0; column < table["cosTheta"].size(); ++column) {
            const float cosine = table["cosTheta"][column];
            SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", cosine " << cosine);
            TestScene dielectric, metal;
            Material white = metal_material(1.0f, roughness);
            white.metalness = 0.0f;
            add_floor(dielectric, dielectric.add(white));
            add_floor(metal, metal.add(metal_material(0.3f, roughness)));
            dielectric.scene.environment.color = metal.scene.environment.color = glm::vec3(1.0f);
            const CameraPose camera = looking_at_origin(up, {1, 0, 0}, cosine);
            const PixelMoments pixel = render(dielectric, camera, 2048);
            // The tables have 6 digits.
            expect_mean(pixel.diffuse, furnace["diffuse_part"][column], 2e-6);
            Moments total{pixel.diffuse.mean + pixel.specular.mean,
                          pixel.diffuse.standard_error + pixel.specular.standard_error};
            expect_mean(total, furnace["total_by_perceptualRoughness"][row][column], 4e-6);
            expect_mean(render(metal, camera, 2048).specular,
                        0.3 * double(table["A"][row][column]) + double(table["B"][row][column]), 4e-6);
        }
    }
}

TEST(golden_closed_forms, smooth_mirror_follows_schlick) {  // 4, 17
    const nlohmann::json values = golden_table("analytic_cases")["mirror_schlick_F0=.04"]["value"];
    for (const auto& [text, value] : values.items()) {
        TestScene scene;
        Material black = metal_material(0.0f, 0.0f);
        black.metalness = 0.0f;
        add_floor(scene, scene.add(black), 100.0f);
        const unsigned lamp = scene.add(lambert_material(0.0f, 3.0f));
        scene.room(glm::vec3(-50, -1, -50), glm::vec3(50, 50, 50), lamp);
        const PixelMoments pixel = render(scene, looking_at_origin(up, {1, 0, 0}, std::stof(text)), 4096);
        // The lobe of the narrowest alpha, 1e-3, is not a delta: it loses 2e-4 at the most grazing view and averages
        // Schlick's curve over a milliradian or two.
        expect_mean(pixel.specular, 3 * double(value), 3 * 1e-3 * double(value));
        expect_mean(pixel.incident, 3.0, 1e-5);
    }
}

TEST(golden_closed_forms, emitter_and_its_mirror_image) {  // 17
    TestScene scene;
    add_floor(scene, scene.add(metal_material(1.0f, 0.0f)));
    const unsigned lamp = scene.add(lambert_material(0.0f, 7.0f));
    scene.quad({-2, 4, -2}, {2, 4, -2}, {2, 4, 2}, {-2, 4, 2}, lamp);
    const CameraPose mirror = looking_at_origin(up, {1, 0, 0}, 1.0f);
    const PixelMoments pixel = render(scene, mirror, 256, {.strategy = LightStrategy::bsdf_only});
    EXPECT_EQ(pixel.incident.mean, glm::dvec3(7.0));
    EXPECT_EQ(pixel.incident.standard_error, glm::dvec3(0.0));
    expect_mean(pixel.specular, 7.0, 7 * 1e-4);  // E = .999999 at alpha = 1e-3, and samples that leave the lobe's core
    const PixelMoments direct = render(scene, looking_along({0, 2, 0}, {0, 1, 0}), 16);
    EXPECT_EQ(direct.diffuse.mean, glm::dvec3(7.0));
    EXPECT_EQ(direct.diffuse.standard_error, glm::dvec3(0.0));
}

TEST(golden_closed_forms, sphere_light_on_lambert) {  // 5
    TestScene scene;
    const glm::vec3 center = 3.0f * glm::vec3(std::sin(M_PI / 6), std::cos(M_PI / 6), 0);
    add_floor(scene, scene.add(lambert_material(0.5f)));
    scene.sphere(center, 1.0f, 48, scene.add(lambert_material(0.0f, 10.0f)));
    const double exact = 0.5 * 10 * mesh_form_factor(scene, 1, glm::dvec3(0), up);
    EXPECT_NEAR(exact, analytic("sphere_light_diffuse"), 0.003 * exact);  // a polyhedron in the sphere has less area
    expect_mean(render(scene, looking_at_origin(up, {0, 0, 1}, 0.2f), 4096).diffuse, exact, 1e-6);
}

TEST(golden_closed_forms, disk_light_on_lambert) {  // 6
    TestScene scene;
    add_floor(scene, scene.add(lambert_material(0.5f)));
    Mesh disk{.name = "disk", .material = scene.add(lambert_material(0.0f, 10.0f))};
    const int n = 256;
    for (int i = 0; i <= n; ++i) {
        const double angle = 2 * M_PI * i / n;
        disk.vertices.push_back({glm::vec3(i == n ? 0 : std::cos(angle), 2, i == n ? 0 : std::sin(angle)),
                                 {0, -1, 0},
                                 {1, 0, 0, 1},
                                 {},
                                 glm::vec4(1)});
        if (i < n) disk.indices.insert(disk.indices.end(), {uint32_t(n), uint32_t(i), uint32_t((i + 1) % n)});
    }
    scene.mesh(std::move(disk));
    // The polygon has 1e-4 less area than its circle.
    expect_mean(render(scene, looking_at_origin(up, {0, 0, 1}, 0.2f), 4096).diffuse, analytic("disk_light_coaxial"),
                2e-4);
}

TEST(golden_closed_forms, rectangle_light_on_lambert) {  // 7
    TestScene near, cornell;
    for (TestScene* scene : {&near, &cornell}) add_floor(*scene, scene->add(lambert_material(0.5f)));
    const unsigned lamp = near.add(lambert_material(0.0f, 10.0f));
    near.quad({-.5f, 1, -.5f}, {.5f, 1, -.5f}, {.5f, 1, .5f}, {-.5f, 1, .5f}, lamp);
    cornell.add(lambert_material(0.0f, 10.0f));
    cornell.quad({-.25f, 1.998f, -.25f}, {.25f, 1.998f, -.25f}, {.25f, 1.998f, .25f}, {-.25f, 1.998f, .25f}, lamp);
    const CameraPose camera = looking_at_origin(up, {0, 0, 1}, 0.2f);
    expect_mean(render(near, camera, 4096).diffuse, 5 * analytic("rect_light_1x1_h1_formfactor_centre"), 1e-6);
    expect_mean(render(cornell, camera, 4096).diffuse, 5 * analytic("rect_light_cornell_direct_F"), 1e-6);
}

TEST(golden_closed_forms, parallel_plates) {  // 8
    TestScene scene;
    const unsigned lower = scene.add(lambert_material(0.5f, 1.0f)), upper = scene.add(lambert_material(0.8f));
    const float half = 1000;
    add_floor(scene, lower, half);
    scene.quad({-half, 1, -half}, {half, 1, -half}, {half, 1, half}, {-half, 1, half}, upper);
    const nlohmann::json value = golden_table("analytic_cases")["two_infinite_diffuse_plates"]["value"];
    // 1e-6 of the light of a plate of 1000 gaps passes its edge at each bounce.
    expect_mean(render(scene, looking_along({0, .5f, 0}, {0, -1, 0}), 4096).diffuse, value[0], 1e-5);
    expect_mean(render(scene, looking_along({0, .5f, 0}, {0, 1, 0}), 4096).diffuse, value[1], 1e-5);
}

TEST(golden_closed_forms, concentric_spheres) {  // 9
    TestScene scene;
    scene.sphere(glm::vec3(0), 0.5f, 48, scene.add(lambert_material(0.5f, 1.0f)));
    scene.sphere(glm::vec3(0), 1.0f, 48, scene.add(lambert_material(0.8f)), true);
    const nlohmann::json value = golden_table("analytic_cases")["concentric_spheres"]["value"];
    // Facets of 48 rings: F21 differs from that of spheres by up to 2 (pi / 96)^2 / 3 at a point.
    expect_mean(render(scene, looking_along({0, 0, .75f}, {.1f, .2f, -1}), 4096).diffuse, value[0], 2e-3);
    expect_mean(render(scene, looking_along({0, 0, .75f}, {.1f, .2f, 1}), 4096).diffuse, value[1], 2e-3);
}

TEST(golden_closed_forms, facing_mirrors) {  // 10
    for (const float reflectance : {0.5f, 0.9f}) {
        TestScene scene;
        Material mirror = metal_material(reflectance, 0.0f);
        mirror.emission = glm::vec3(1.0f);
        const unsigned material = scene.add(mirror);
        add_floor(scene, material, 100);
        scene.quad({-100, 1, -100}, {100, 1, -100}, {100, 1, 100}, {-100, 1, 100}, material);
        const CameraPose camera = looking_along({0, .5f, 0}, {0, -1, 0});
        for (const unsigned depth : {4u, 64u})
            for (const bool roulette : {false, true}) {
                const PixelMoments pixel =
                    render(scene, camera, 1024, {.max_depth = depth, .russian_roulette = roulette});
                const Moments total{pixel.diffuse.mean + pixel.specular.mean, pixel.specular.standard_error};
                const double exact = (1 - std::pow(double(reflectance), depth + 1)) / (1 - reflectance);
                // Each reflection at alpha = 1e-3 loses 1e-6, and a few of 1e5 rays leave the narrow core of the lobe.
                expect_mean(total, exact, 1e-4 * exact);
                if (depth == 4) {
                    // What is missing is R^(depth + 1) of the whole. With roulette as many of 16384 paths are left to
                    // determine it, each with throughput 1: 6 standard errors.
                    const double cut = std::pow(double(reflectance), depth + 1);
                    EXPECT_NEAR(pixel.cut, cut, 1e-4 * cut + (roulette ? 6 * std::sqrt(cut / 16384) : 0));
                }
                if (depth == 64) {
                    EXPECT_NEAR(
                        exact,
                        analytic(reflectance < 0.6f ? "facing_mirrors_axis_R0.5_Le1" : "facing_mirrors_axis_R0.9_Le1"),
                        0.012);
                }
            }
    }
}

TEST(golden_closed_forms, mirror_box_of_constant_fresnel) {  // 11
    TestScene scene;
    Material mirror = metal_material(0.5f, 0.0f);
    mirror.emission = glm::vec3(1.0f);
    scene.room(glm::vec3(-1), glm::vec3(1), scene.add(mirror));
    const PixelMoments pixel = render(scene, looking_along({.2f, .1f, .3f}, {.4f, -.5f, -1}), 1024,
                                      {.model = ReflectionModel::constant_fresnel});
    const Moments total{pixel.diffuse.mean + pixel.specular.mean, pixel.specular.standard_error};
    expect_mean(total, 2.0, 2e-4);  // the lobe of alpha = 1e-3 loses up to 2e-5 in these directions
}

TEST(golden_closed_forms, lambert_under_gradient) {  // 12
    TestScene scene;
    add_floor(scene, scene.add(lambert_material(0.5f)));
    scene.scene.environment = {
        .type = Environment::Type::gradient, .color = glm::vec3(1), .slope = glm::vec3(.8f), .axis = {.8f, .6f, 0}};
    const CameraPose camera = looking_at_origin(up, {0, 0, 1}, 0.3f);
    expect_mean(render(scene, camera, 2048).diffuse, analytic("lambert_linear_gradient"), 1e-6);

    // The quadratic one as a lat-long image, through the importance table.
    Environment& environment = scene.scene.environment;
    environment.type = Environment::Type::image;
    environment.latlong = HostImage({512, 256}, 3);
    for (unsigned y = 0; y < 256; ++y)
        for (unsigned x = 0; x < 512; ++x) {
            const double azimuth = 2 * M_PI * ((x + 0.5) / 512 - 0.5), polar = M_PI * (y + 0.5) / 256;
            const double cosine = 0.8 * std::sin(polar) * std::cos(azimuth) + 0.6 * std::cos(polar);
            environment.latlong.set_rgb(size_t(y) * 512 + x,
                                        glm::vec3(float(1 + 0.5 * 0.5 * (3 * cosine * cosine - 1))));
        }
    // Bilinear filtering flattens a quadratic by its curvature times (texel angle)^2 / 8: 3e-5.
    expect_mean(render(scene, camera, 4096).diffuse, analytic("lambert_sh2"), 5e-5);
}

TEST(golden_closed_forms, ggx_under_gradient) {  // 13
    const nlohmann::json table = golden_table("ggx_albedo"), moments = table["first_moments"];
    const glm::vec3 axis = glm::normalize(glm::vec3(-0.5f, 0.6f, 0.4f));
    for (size_t row = 0; row < table["alpha"].size(); ++row)
        for (size_t column = 0; column < table["cosTheta"].size(); ++column) {
            const float alpha = table["alpha"][row], cosine = table["cosTheta"][column];
            SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", cosine " << cosine);
            TestScene scene;
            add_floor(scene, scene.add(metal_material(1.0f, std::sqrt(alpha))));
            scene.scene.environment = {
                .type = Environment::Type::gradient, .color = glm::vec3(1), .slope = glm::vec3(.8f), .axis = axis};
            // The viewer is at +x, so the mirror tangent is -x.
            const double exact = double(table["E"][row][column]) + 0.8 * (-axis.x * double(moments["Mt"][row][column]) +
                                                                          axis.y * double(moments["Mz"][row][column]));
            expect_mean(render(scene, looking_at_origin(up, {1, 0, 0}, cosine), 2048).specular, exact,
                        5e-6 + rare_losses(table["E"][row][column], 2048));
        }
}

TEST(golden_closed_forms, point_light_on_ggx) {  // 15
    TestScene scene;
    add_floor(scene, scene.add(metal_material(1.0f, 0.5f)), 10);
    const float s = std::sqrt(0.5f);
    scene.scene.lights = {{.intensity = glm::vec3(float(M_PI)), .position = {-2 * s, 2 * s, 0}}};
    const PixelMoments pixel = render(scene, looking_at_origin(up, {1, 0, 0}, std::cos(float(M_PI) / 6)), 16);
    EXPECT_NEAR(pixel.hit.highlight.x, analytic("ggx_point_light_a.25"), 2e-6);
    EXPECT_EQ(pixel.specular.mean.x, 0.0);  // no ray meets a point
    EXPECT_EQ(pixel.incident.mean.x, 0.0);
}

TEST(golden_closed_forms, black_sphere_shadows_the_sky) {  // 16
    TestScene scene;
    add_floor(scene, scene.add(lambert_material(0.5f)), 100);
    scene.sphere({0, 3, 0}, 1, 48, scene.add(lambert_material(0.0f)));
    scene.scene.environment.color = glm::vec3(1);
    const double exact = 0.5 * (1 - mesh_form_factor(scene, 1, glm::dvec3(0), up));
    EXPECT_NEAR(exact, analytic("black_sphere_occluder_unit_env"), 3e-4);  // the polyhedron hides less
    expect_mean(render(scene, looking_at_origin(up, {0, 0, 1}, 0.1f), 4096).diffuse, exact, 1e-6);
}
