#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/pixel_position.h"
#include "core/shared/brdf.h"
#include "core/split_sum.h"
#include "groundtruth/paths/path_tracer.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>

namespace {

/// The formula of Compositor on the CPU. `radiance` has 3 channels or more, `confidence` 1 or more. RGB.
struct HostComposite {
    HostImage specular, image;
};
HostComposite composite(const HostGBuffer& g, const HostImage& radiance, const HostImage& confidence,
                        CompositeFormula formula = CompositeFormula::split_sum) {
    HostComposite result{specular_reflectance(g), HostImage(g.extent(), 3)};
    for (size_t i = 0; i < result.image.pixel_count(); ++i) {
        const glm::vec3 fallback = g.fallback.values.empty() ? glm::vec3(0) : g.fallback.rgb(i);
        const float weight = confidence.values[i * confidence.channels];
        const bool is_added = formula == CompositeFormula::additive_fresnel;
        glm::vec3 specular =
            result.specular.rgb(i) * (is_added ? fallback : glm::mix(fallback, radiance.rgb(i), weight));
        if (is_added) {
            const float *n = &g.normal.values[4 * i], *c = &g.base_color.values[4 * i];
            const float mu_o = -float(glm::dot(glm::dvec3(n[0], n[1], n[2]), view_direction(g, i)));
            specular += radiance.rgb(i) * additive_weight({c[0], c[1], c[2]}, c[3], mu_o, weight);
        }
        result.specular.set_rgb(i, is_background(g, i) ? glm::vec3(0) : specular);
        result.image.set_rgb(i, g.lit.rgb(i) + result.specular.rgb(i));
    }
    return result;
}

/// Confidence in an image of its own, or in the alpha channel of the radiance, whose other channels hold numbers that
/// would do for a confidence.
void expect_composite_of_the_cpu(Rasterizer& rasterizer, const GBuffer& gbuffer, bool is_in_alpha,
                                 CompositeFormula formula) {
    PassList& pass_list = rasterizer.pass_list();
    HostImage radiance(pass_list.extent(), 4), confidence(pass_list.extent(), 1);
    for (size_t i = 0; i < radiance.pixel_count(); ++i) {
        radiance.set_rgb(i, glm::vec3(i % 7, i % 5, i % 3));
        radiance.values[4 * i + 3] = confidence.values[i] = (i % 11) / 10.0f;
    }
    Reflections reflections{pass_list.image("some_radiance", Format::rgba32f),
                            pass_list.image("some_confidence", Format::r32f)};
    pass_list.upload(reflections.radiance, radiance);
    pass_list.upload(reflections.confidence, confidence);
    if (is_in_alpha) reflections = {reflections.radiance, reflections.radiance, 3};
    Compositor compositor(pass_list, formula);
    const Composite result = compositor.render(gbuffer, reflections);
    const HostImage specular = pass_list.download(result.specular), image = pass_list.download(result.image);
    const HostGBuffer g = download_gbuffer(pass_list, gbuffer, rasterizer.camera(), DepthFormat::d32f);
    const HostComposite expected = composite(g, radiance, confidence, formula);
    double largest = 0;
    for (size_t i = 0; i < specular.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c) {
            // Float32 on both sides; the split sum's slope at grazing multiplies the rounding of the cosine.
            ASSERT_NEAR(specular.rgb(i)[c], expected.specular.rgb(i)[c], 1e-4f);
            ASSERT_NEAR(image.rgb(i)[c], expected.image.rgb(i)[c], 1e-4f);
            largest = std::max<double>(largest, specular.rgb(i)[c]);
            if (g.material_id.values[i] == 0) {
                ASSERT_EQ(specular.rgb(i)[c], 0.0f);
                ASSERT_EQ(image.rgb(i)[c], g.lit.rgb(i)[c]);
            }
        }
    EXPECT_GT(largest, 1.0);
}

}  // namespace

class composite_of : public testing::TestWithParam<Scene (*)()> {};

TEST_P(composite_of, the_gpu_is_the_formula_on_the_cpu) {
    const Scene scene = GetParam()();
    const glm::uvec2 extent(101, 67);
    Rasterizer rasterizer(test_device(), scene, {.extent = extent});
    FrameView view = view_of(extent, 3, DepthDirection::reversed);
    view.jitter = {0.2f, 0.1f};
    for (const char* name : {"main", "orthographic"}) {
        const GBuffer gbuffer = rasterizer.render(scene.camera(name), view);
        rasterizer.light_directly(gbuffer);
        for (const bool is_in_alpha : {false, true})
            for (const CompositeFormula formula : {CompositeFormula::split_sum, CompositeFormula::additive_fresnel}) {
                SCOPED_TRACE(testing::Message()
                             << name << ", confidence in alpha " << is_in_alpha << ", formula " << int(formula));
                expect_composite_of_the_cpu(rasterizer, gbuffer, is_in_alpha, formula);
            }
    }
}
INSTANTIATE_TEST_SUITE_P(scenes, composite_of, testing::Values(varied_scene, dielectric_scene));

/// The truth has the same reflectance at every pixel, coloured or not.
TEST(composite, reflectance_is_that_of_the_path_tracer) {
    const Scene scene = dielectric_scene();
    const FrameView view = view_of({64, 40});
    Rasterizer rasterizer(test_device(), scene, {.extent = view.extent});
    const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view);
    const HostGBuffer g = download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f);
    const HostImage reflectance = specular_reflectance(g);
    const ScenePose pose = pose_scene(scene, 0);
    const PathTracer tracer(scene, pose, pose_camera(scene.camera("main"), pose, 0), view.extent, {.ladder = true});
    size_t compared = 0, colored = 0, alike = 0;
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) {
            const FirstHit hit = tracer.first_hit(x, y);
            const size_t i = size_t(y) * view.extent.x + x;
            if (!hit.is_hit || hit.is_unlit || g.material_id.values[i] != float(hit.material + 1)) continue;
            const glm::vec3 found = reflectance.rgb(i);
            ++compared, colored += std::abs(found.x - found.z) > 0.1f;
            alike += glm::length(found - hit.reflectance) < 0.02f;  // as agreement.cpp: textures change within a pixel
        }
    EXPECT_GE(double(alike), 0.99 * double(compared));
    EXPECT_GT(colored, 50u);
}

TEST(composite, additive_weight_has_the_printed_values) {
    const glm::vec3 gold(1.0f, 0.7f, 0.3f);
    const auto expect = [&](float metalness, float mu_o, float weight, glm::vec3 expected) {
        const glm::vec3 found = additive_weight(gold, metalness, mu_o, weight);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], 1e-6f) << metalness << " " << mu_o << " " << weight;
    };
    expect(0, 1, 1, glm::vec3(0.04f));
    expect(0, 0, 1, glm::vec3(1));
    expect(0, 0.5f, 1, glm::vec3(0.07f));  // 0.04 + 0.96 / 32
    expect(1, 1, 1, 0.5f * gold);          // metals lose half
    expect(1, 1, 0.5f, 0.375f * gold);     // 0.5 (1 - 0.25)
    expect(0.5f, 1, 1, 0.75f * 0.5f * (gold + glm::vec3(0.04f)));
    expect(1, 0.3f, 0, glm::vec3(0));
}

TEST(composite, added_reflections_leave_the_environment_in_place) {
    // Two mirrors' worth of light: what a hit shows is added to the fallback that it should replace.
    const Scene scene = varied_scene();
    const glm::uvec2 extent(50, 40);
    Rasterizer rasterizer(test_device(), scene, {.extent = extent});
    const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view_of(extent));
    rasterizer.light_directly(gbuffer);
    const HostGBuffer g = download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f);
    HostImage radiance(extent, 3), none(extent, 1), all(extent, 1, 1.0f);
    for (size_t i = 0; i < radiance.pixel_count(); ++i) radiance.set_rgb(i, glm::vec3(2));
    const auto by = [&](const HostImage& confidence) {
        return composite(g, radiance, confidence, CompositeFormula::additive_fresnel).specular;
    };
    const HostImage without = by(none), with = by(all), replaced = composite(g, radiance, none).specular;
    EXPECT_EQ(without.values, replaced.values) << "nothing found: both formulas agree";
    size_t brighter = 0;
    for (size_t i = 0; i < with.values.size(); ++i) {
        ASSERT_GE(with.values[i], without.values[i]);
        brighter += with.values[i] > without.values[i];
    }
    EXPECT_GT(brighter, 1000u);
}

TEST(composite, the_environment_in_lit_is_seen_by_rays_but_not_composited_twice) {
    const Scene scene = varied_scene();
    const glm::uvec2 extent(50, 40);
    Rasterizer rasterizer(test_device(), scene, {.extent = extent});
    PassList& pass_list = rasterizer.pass_list();
    Compositor compositor(pass_list);
    const GBuffer without = rasterizer.render(scene.camera("main"), view_of(extent));
    rasterizer.light_directly(without);
    const HostGBuffer g = download_gbuffer(pass_list, without, rasterizer.camera(), DepthFormat::d32f);
    GBuffer with = without;
    compositor.add_environment(with);

    const HostImage lit = pass_list.download(with.lit), reflectance = specular_reflectance(g);
    size_t brighter = 0;
    for (size_t i = 0; i < lit.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float added = is_background(g, i) ? 0.0f : reflectance.rgb(i)[c] * g.fallback.rgb(i)[c];
            ASSERT_NEAR(lit.rgb(i)[c], g.lit.rgb(i)[c] + added, 1e-4f) << "float32 sums, as above";
            brighter += added > 0.01f;
        }
    EXPECT_GT(brighter, 1000u);

    const auto image = [&](const GBuffer& gbuffer) {
        return pass_list.download(compositor.render(gbuffer, {gbuffer.normal, gbuffer.normal, 3}).image);
    };
    EXPECT_EQ(differing_bits(image(with), image(without)), 0u);
}

TEST(composite, reflectance_is_the_split_sum_of_the_brdf) {
    // One floor seen at every angle: F0 A + F90 B from direct quadrature at the pixel's cosine.
    Scene scene = varied_scene();
    scene.instances.resize(1);
    const SceneCamera camera = scene.camera("main");
    const glm::uvec2 extent(16, 64);
    for (const float roughness : {0.1f, 0.4f, 0.9f}) {
        scene.materials[0].roughness = roughness;
        scene.materials[0].metalness = 0.5f;
        Rasterizer rasterizer(test_device(), scene, {.extent = extent});
        const HostGBuffer g = download_gbuffer(rasterizer.pass_list(), rasterizer.render(camera, view_of(extent)),
                                               rasterizer.camera(), DepthFormat::d32f);
        const HostImage reflectance = specular_reflectance(g);
        const CameraPose pose = pose_camera(camera, pose_scene(scene, 0), 0);
        for (unsigned y = 0; y < extent.y; ++y) {
            if (*g.material_id.pixel(3, y) == 0) continue;
            const float mu_o = -camera_ray(pose, extent, {3.5f, y + 0.5f}).direction.y;
            if (mu_o < 0.02f) continue;  // half a texel of the table
            const glm::dvec2 ab = split_sum(mu_o, ggx_alpha(roughness));
            const double expected = 0.5 * (0.04 + 0.5) * ab.x + ab.y;
            // Bilinear reading of 64 x 64 texels.
            EXPECT_NEAR(reflectance.pixel(3, y)[0], expected, 5e-3) << "roughness " << roughness << ", cosine " << mu_o;
        }
    }
}

TEST(composite, of_what_reflects_nothing_does_not_need_the_fallback) {
    Scene scene = varied_scene();
    for (Material& material : scene.materials) material.specular = material.metalness = 0;
    const glm::uvec2 extent(50, 40);
    HostImage images[2];
    for (const bool keep_all : {false, true}) {
        Rasterizer rasterizer(test_device(), scene, {.extent = extent, .keep_all = keep_all});
        const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view_of(extent));
        rasterizer.light_directly(gbuffer);
        PassList& pass_list = rasterizer.pass_list();
        const Reflections none{pass_list.image("radiance", Format::rgba32f),
                               pass_list.image("confidence", Format::r32f)};
        pass_list.clear(none.radiance, glm::vec4(0));
        pass_list.clear(none.confidence, glm::vec4(0));
        Compositor compositor(pass_list);
        images[keep_all] = pass_list.download(compositor.render(gbuffer, none).image);
    }
    EXPECT_EQ(differing_bits(images[0], images[1]), 0u);
    EXPECT_TRUE(std::ranges::any_of(left_out_of_rasterizer(material_facts(scene)),
                                    [](const LeftOut& part) { return part.what == "fallback"; }));
}
