#include "tests/variants/amd_golden.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <random>

namespace {

/// Both forms have the same rules.
const std::vector<std::string> forms = {"faithful", "fast"};

struct AmdClassification : TechniqueTest {};

/// A G-buffer whose pixels have each their own kind: background, no specular term, mirror, below and above the
/// threshold, in patches small enough that quads are mixed.
HostGBuffer patchwork(glm::uvec2 extent, bool is_reversed) {
    HostGBuffer gbuffer;
    gbuffer.camera.extent = {extent, 1.0f / glm::vec2(extent)};
    gbuffer.camera.depth = {0.1f, 100.0f, is_reversed ? 0.0f : 1.0f, is_reversed};
    gbuffer.depth = gbuffer.previous_depth = HostImage(extent, 1, 0.5f);
    gbuffer.motion = HostImage(extent, 2);
    gbuffer.material_id = HostImage(extent, 1, 1.0f);
    for (HostImage* image : {&gbuffer.geometric_normal, &gbuffer.normal, &gbuffer.base_color, &gbuffer.emission,
                             &gbuffer.previous_normal, &gbuffer.lit})
        *image = HostImage(extent, 4);
    gbuffer.fallback = HostImage(extent, 4, 0.25f);
    std::mt19937 random(3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const unsigned kind = x < 20 ? 0 : random() % 6;  // 0: background, so that whole tiles are empty
            if (kind == 0) *gbuffer.depth.pixel(x, y) = gbuffer.camera.depth.z;
            gbuffer.base_color.pixel(x, y)[3] = kind == 2;
            gbuffer.emission.pixel(x, y)[3] = kind > 2;
            const float roughness[] = {0.0f, 0.1f, 0.005f, 0.3f, 0.44f, 0.45f};  // the threshold is 0.4472
            gbuffer.normal.pixel(x, y)[3] = roughness[kind];
        }
    return gbuffer;
}

/// What each pixel does, one after the other, from the rules of SSSR 1.5's classification.
struct Expected {
    HostImage rays, tiles, glossy;
};
Expected classify(const HostGBuffer& gbuffer, unsigned rays_per_quad, const HostImage* variance, bool serves_orphans) {
    const glm::uvec2 extent = gbuffer.extent();
    Expected expected{HostImage(extent, 1), HostImage((extent + 7u) / 8u, 1), HostImage(extent, 1)};
    HostImage waits(extent, 1);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const float alpha = gbuffer.normal.pixel(x, y)[3] * gbuffer.normal.pixel(x, y)[3];
            const bool has_specular = gbuffer.base_color.pixel(x, y)[3] > 0 || gbuffer.emission.pixel(x, y)[3] > 0;
            if (*gbuffer.depth.pixel(x, y) == gbuffer.camera.depth.z || !has_specular || alpha >= 0.2f) continue;
            *expected.glossy.pixel(x, y) = 1;
            *expected.tiles.pixel(x / 8, y / 8) = 1;
            const bool is_chosen =
                rays_per_quad == 4 || (rays_per_quad == 2 ? x % 2 == y % 2 : x % 2 == 0 && y % 2 == 0);
            const bool is_noisy = variance && *variance->pixel(x, y) > 0.5f;
            *(is_chosen || is_noisy || alpha < 1e-4f ? expected.rays : waits).pixel(x, y) = 1;
        }
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            if (*waits.pixel(x, y) == 0) continue;
            const unsigned from_x = rays_per_quad == 1 ? x & ~1u : x ^ 1, from_y = rays_per_quad == 1 ? y & ~1u : y;
            float& ray = *expected.rays.pixel(from_x, from_y);
            if (ray > 0)
                ray += float(2 << (from_x != x && from_y != y ? 2 : from_y != y ? 1 : 0));
            else if (serves_orphans)
                *expected.rays.pixel(x, y) = 1;
        }
    return expected;
}

/// Below, at and above the threshold of 0.5.
HostImage random_variance(glm::uvec2 extent) {
    HostImage variance(extent, 1);
    std::mt19937 random(4);
    for (float& v : variance.values) v = 0.5f * float(random() % 3);
    return variance;
}

/// Also at sizes whose last tiles and quads are cut.
TEST_F(AmdClassification, ListsWhatTheRulesSay) {
    for (const glm::uvec2 extent : {glm::uvec2(96, 64), glm::uvec2(101, 59)})
        for (const bool is_reversed : {false, true}) {
            const HostGBuffer gbuffer = patchwork(extent, is_reversed);
            const HostImage variance = random_variance(extent);
            for (const unsigned rays : {1u, 2u, 4u})
                for (const bool is_guided : {false, true})
                    for (const bool serves_orphans : {false, true}) {
                        const Expected expected =
                            classify(gbuffer, rays, is_guided ? &variance : nullptr, serves_orphans);
                        for (const std::string& form : forms) {
                            SCOPED_TRACE(testing::Message()
                                         << extent.x << "x" << extent.y << ", " << rays << " rays, guided " << is_guided
                                         << ", orphans " << serves_orphans << ", " << form);
                            const AmdTraced found = amd_classify_frame(device(), gbuffer,
                                                                       {{"samples_per_quad", rays},
                                                                        {"guided_tracing", is_guided},
                                                                        {"variance_threshold", 0.5},
                                                                        {"trace_orphans", serves_orphans},
                                                                        {"denoiser_form", form}},
                                                                       &variance);
                            EXPECT_EQ(map_of_rays(found, extent).values, expected.rays.values);
                            EXPECT_EQ(map_of_tiles(found, extent).values, expected.tiles.values);
                            EXPECT_EQ(found.confidence.values, expected.glossy.values);
                        }
                    }
        }
}

TEST_F(AmdClassification, GivesRoughSurfacesTheFallbackAndAllOthersBlack) {
    const HostGBuffer gbuffer = patchwork({96, 64}, false);
    for (const std::string& form : forms) {
        const AmdTraced found = amd_classify_frame(device(), gbuffer, {{"ibl_factor", 3.0}, {"denoiser_form", form}});
        for (unsigned y = 0; y < 64; ++y)
            for (unsigned x = 0; x < 96; ++x) {
                const bool is_rough_surface = *gbuffer.depth.pixel(x, y) != 1.0f && *found.confidence.pixel(x, y) == 0;
                EXPECT_EQ(found.radiance.pixel(x, y)[1], is_rough_surface ? 0.75f : 0.0f) << x << ", " << y;
            }
    }
}

/// Widths that 8 bits round across a limit. What later passes make of a pixel hangs on the alpha that they read: a
/// glossy one below the threshold of 0.2, a mirror below 1e-4. By what is not rounded yet the original traces 0.199,
/// which is then 51/255 and never denoised, and sends one ray per quad into 0.001, which is then a mirror's 0.
TEST_F(AmdClassification, RateStoredRoughnessRatesAsLaterPassesDo) {
    HostGBuffer gbuffer = patchwork({96, 64}, false);
    for (const float alpha : {0.199f, 0.001f})
        for (const bool is_rated_as_stored : {false, true}) {
            SCOPED_TRACE(testing::Message() << alpha << ", as stored " << is_rated_as_stored);
            for (size_t i = 3; i < gbuffer.normal.values.size(); i += 4) gbuffer.normal.values[i] = std::sqrt(alpha);
            const AmdTraced found = amd_classify_frame(
                device(), gbuffer,
                {{"rate_stored_roughness", is_rated_as_stored}, {"guided_tracing", false}, {"samples_per_quad", 1}});
            const HostImage rays = map_of_rays(found, gbuffer.extent());
            unsigned glossy = 0, glossy_as_read = 0, traced = 0, mirrors_as_read = 0;
            for (size_t i = 0; i < rays.pixel_count(); ++i) {
                glossy += found.confidence.values[i] > 0;
                glossy_as_read += found.roughness.values[i] < 0.2f;
                traced += rays.values[i] > 0;
                mirrors_as_read += found.roughness.values[i] < 1e-4f;
            }
            EXPECT_EQ(glossy == glossy_as_read, is_rated_as_stored || alpha < 0.1f);
            EXPECT_EQ(traced >= mirrors_as_read, is_rated_as_stored || alpha > 0.1f);
            EXPECT_GT(alpha < 0.1f ? mirrors_as_read : found.roughness.pixel_count() - glossy_as_read, 1000u);
        }
}

TEST_F(AmdClassification, ListsNothingWhereNothingIsGlossy) {
    HostGBuffer gbuffer = patchwork({96, 64}, false);
    for (size_t i = 3; i < gbuffer.normal.values.size(); i += 4) gbuffer.normal.values[i] = 0.5f;
    const AmdTraced found =
        amd_trace_frame(device(), gbuffer, nlohmann::json::object(), HostImage({128, 128}, 2, 0.5f));
    EXPECT_EQ(found.arguments, (std::vector<uint32_t>{0, 0, 1, 0, 0, 1}));
    EXPECT_TRUE(found.rays.empty() && found.tiles.empty());
}

struct AmdClassificationOf : TechniqueTest, testing::WithParamInterface<std::string> {
    const HostGBuffer gbuffer = amd_golden_gbuffer(GetParam());

    void expect_equal(unsigned rays_per_quad, const std::string& file) {
        for (const std::string& form : forms) expect_equal(rays_per_quad, file, form);
    }

    void expect_equal(unsigned rays_per_quad, const std::string& file, const std::string& form) {
        SCOPED_TRACE(file + ", " + form);
        const AmdTraced found = amd_classify_frame(
            device(), gbuffer,
            {{"samples_per_quad", rays_per_quad}, {"guided_tracing", false}, {"denoiser_form", form}});
        const LayeredImage golden = read_golden(GetParam() + "/" + file);
        HostImage rays = golden_layer(golden, "ray");
        for (size_t i = 0; i < rays.values.size(); ++i)
            rays.values[i] += 2 * golden_layer(golden, "copyH").values[i] +
                              4 * golden_layer(golden, "copyV").values[i] + 8 * golden_layer(golden, "copyD").values[i];
        EXPECT_EQ(map_of_rays(found, gbuffer.extent()).values, rays.values);
        EXPECT_EQ(found.roughness.values, golden_layer(golden, "alpha8").values);
        EXPECT_EQ(map_of_tiles(found, gbuffer.extent()).values,
                  golden_layer(read_golden(GetParam() + "/tiles.exr"), "tile").values);
        for (size_t i = 0; i < rays.values.size(); ++i)  // a constant environment: the original's filtering keeps it
            ASSERT_EQ(found.radiance.rgb(i), golden_layer(golden, "rad").rgb(i)) << i;
    }
};

TEST_P(AmdClassificationOf, EqualsTheOriginals) {
    expect_equal(1, "classify_spq1.exr");
    expect_equal(2, "classify_spq2.exr");
    expect_equal(4, "classify.exr");
}

INSTANTIATE_TEST_SUITE_P(golden_amd_classification, AmdClassificationOf, testing::ValuesIn(amd_tracer_sets()),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
