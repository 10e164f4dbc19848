// What rays show, and their confidence.
#include "tests/variants/diligent_hits.h"

#include <algorithm>
#include <random>

namespace {

/// Of the pixel of a 2x2 block that its ray stands for; bit 0: right, bit 1: lower.
unsigned place_in_block(unsigned x, unsigned y) {
    const char* const places[4] = {"0123", "3210", "1032", "2301"};  // [x][y] of the block
    return unsigned(places[x & 3][y & 3] - '0');
}

TEST_F(DiligentHits, AreWhereMirrorRaysMeetTheWall) {
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed})
        for (const char* preset : {"april_2024", "current", "corrected"}) {
            SCOPED_TRACE(testing::Message() << preset << ", reversed " << (direction == DepthDirection::reversed));
            view.depth_direction = direction;
            const std::vector<Preset>& presets = find_technique("diligent_ssr").presets;
            nlohmann::json parameters = std::ranges::find(presets, preset, &Preset::name)->parameters;
            parameters.erase("repair_inputs");  // of the whole technique, not of its tracing
            const Quality found = quality(parameters);
            EXPECT_GT(found.rays, 3000u);
            EXPECT_GT(found.right, 0.99);
        }
}

TEST_F(DiligentHits, AreNoneWhereSurfacesAreMetFromBehind) {
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    EXPECT_GT(confidence_of(trace(gbuffer)), 1000);
    for (size_t i = 0; i < gbuffer.normal.pixel_count(); ++i)
        if (gbuffer.base_color.values[4 * i + 3] == 0)  // the wall, which now faces away
            for (size_t c = 4 * i; c < 4 * i + 3; ++c) gbuffer.normal.values[c] *= -1;
    EXPECT_EQ(confidence_of(trace(gbuffer)), 0);
}

/// Each ray of the halved image is the one that a pixel of its block would have with that random number.
TEST_F(DiligentHits, HalfResolutionTracesOnePixelOfEachBlock) {
    view.extent = {127, 121};
    const HostGBuffer gbuffer = gbuffer_of([](const CameraRay& ray) {
        SyntheticHit hit = floor_before_white(ray);
        if (hit.metalness > 0) hit.roughness = 0.15f;
        return hit;
    });
    std::mt19937 random(1);
    for (float& number : noise.values) number = float(random() % 256) / 255;
    const DiligentTraced half = trace(gbuffer, {{"half_resolution", true}});
    ASSERT_EQ(half.radiance.extent, glm::uvec2(63, 60));
    HostImage of_pixels({128, 128}, 2);
    const auto pixel_of = [&](unsigned x, unsigned y) {
        const unsigned place = place_in_block(x, y);
        return glm::uvec2(2 * x + (place & 1), 2 * y + (place >> 1));
    };
    for (unsigned y = 0; y < 60; ++y)
        for (unsigned x = 0; x < 63; ++x)
            std::copy_n(noise.pixel(x, y), 2, of_pixels.pixel(pixel_of(x, y).x, pixel_of(x, y).y));
    noise = of_pixels;
    const DiligentTraced full = trace(gbuffer);
    unsigned rays = 0;
    for (unsigned y = 0; y < 60; ++y)
        for (unsigned x = 0; x < 63; ++x) {
            const glm::uvec2 pixel = pixel_of(x, y);
            if (gbuffer.base_color.pixel(pixel.x, pixel.y)[3] == 0) continue;
            ++rays;
            for (unsigned c = 0; c < 4; ++c) {
                EXPECT_EQ(half.radiance.pixel(x, y)[c], full.radiance.pixel(pixel.x, pixel.y)[c]) << x << ", " << y;
                EXPECT_EQ(half.direction.pixel(x, y)[c], full.direction.pixel(pixel.x, pixel.y)[c]) << x << ", " << y;
            }
        }
    EXPECT_GT(rays, 1000u);
}

/// A block that shows the floor in one pixel and nothing in the one that its ray stands for.
TEST_F(DiligentHits, HalfResolutionTracesNothingFromTheBackground) {
    const HostGBuffer gbuffer = gbuffer_of(floor_below_nothing);
    const HostImage found = trace(gbuffer, {{"half_resolution", true}}).direction;
    const auto is_floor = [&](unsigned x, unsigned y) { return *gbuffer.depth.pixel(x, y) < 1 - 1e-6f; };
    unsigned blocks = 0;
    for (unsigned y = 0; y < found.extent.y; ++y)
        for (unsigned x = 0; x < found.extent.x; ++x) {
            const unsigned place = place_in_block(x, y);
            if (is_floor(2 * x + (place & 1), 2 * y + (place >> 1))) continue;
            bool shows_floor = false;
            for (unsigned i = 0; i < 4; ++i) shows_floor |= is_floor(2 * x + (i & 1), 2 * y + (i >> 1));
            blocks += shows_floor;
            for (unsigned c = 0; c < 4; ++c) EXPECT_EQ(found.pixel(x, y)[c], 0) << x << ", " << y;
        }
    EXPECT_GT(blocks, 10u);
}

/// The wall faces the camera almost, so that rays end on it, wherever within a pixel they meet it: nothing is taken off
/// their confidence, whether positions undo the jitter or, as in the original, all ignore it alike.
TEST_F(DiligentHits, AreAsSureWithJitter) {
    view.jitter = {0.45f, -0.4f};
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    encode_hits(gbuffer);
    for (const bool is_undone : {false, true}) {
        const HostImage found = trace(gbuffer, {{"hierarchy.unproject_jitter", is_undone}}).radiance;
        unsigned hits = 0;
        for (size_t i = 0; i < found.pixel_count(); ++i) {
            const glm::vec2 hit(found.rgb(i));
            if (found.values[4 * i + 3] == 0 || fade_at(hit, glm::vec2(view.extent)) < 1) continue;
            const glm::uvec2 pixel(hit * glm::vec2(view.extent));
            if (gbuffer.base_color.pixel(pixel.x, pixel.y)[3] > 0) continue;  // beyond the wall's edge a ray passes
            EXPECT_GT(found.values[4 * i + 3], 0.99f) << i;
            ++hits;
        }
        EXPECT_GT(hits, 1000u);
    }
}

/// The wall moved, the floor says to have moved otherwise: it is the hit's motion that counts. Where both places are
/// well inside the image the confidence is 1, and nearer its border that of the one that fades more.
TEST_F(DiligentHits, PreviousFrameShowsWhereHitsWereThen) {
    const glm::vec2 of_wall(0.11f, -0.07f), extent(view.extent);
    HostGBuffer gbuffer = gbuffer_of(floor_before_white);
    for (size_t i = 0; i < gbuffer.motion.pixel_count(); ++i) {
        const bool is_wall = gbuffer.base_color.values[4 * i + 3] == 0;
        gbuffer.motion.values[2 * i] = is_wall ? of_wall.x : 0.3f;
        gbuffer.motion.values[2 * i + 1] = is_wall ? of_wall.y : 0.2f;
    }
    HostGBuffer encoded = gbuffer;
    encode_hits(encoded);
    const HostImage found =
        trace(gbuffer, {{"previous_frame", true}, {"hierarchy.relative_depth_buffer_thickness", 0.5}}, &encoded.lit)
            .radiance;
    unsigned shown = 0, wrong = 0, faded_now = 0, faded_then = 0;
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) {
            const std::optional<Mirrored> expected = mirrored(x, y);
            if (!expected) continue;
            const glm::vec2 now = expected->pixel / extent, then = now - of_wall;
            const float fade = std::min(fade_at(now, extent), fade_at(then, extent));
            const float* ours = found.pixel(x, y);
            EXPECT_NEAR(ours[3], fade, 1e-3f) << x << ", " << y;
            faded_now += fade_at(now, extent) < fade_at(then, extent);
            faded_then += fade_at(then, extent) < fade_at(now, extent);
            if (fade == 0 || ours[3] == 0) continue;
            ++shown;
            const glm::vec2 apart = glm::abs(glm::vec2(ours[0], ours[1]) - then) * extent;
            wrong += !(apart.x < 1 && apart.y < 1);
        }
    EXPECT_GT(shown, 2000u);
    EXPECT_LT(wrong, shown / 200);
    EXPECT_GT(faded_now, 100u);
    EXPECT_GT(faded_then, 100u);
}

/// Images below 64 pixels have fewer levels than the original reads.
TEST_F(DiligentHits, AreFoundInSmallImages) {
    view = {.extent = {40, 30}, .depth_direction = DepthDirection::reversed};
    const Quality found = quality({{"hierarchy.partial_texels", "clamped"}, {"hierarchy.accept_contact_hits", true}});
    EXPECT_GT(found.rays, 200u);
    EXPECT_GT(found.right, 0.99);

    HostGBuffer glossy = gbuffer_of(floor_before_white);
    for (size_t i = 3; i < glossy.normal.values.size(); i += 4) glossy.normal.values[i] = 0.1f;
    EXPECT_EQ(trace(glossy, {{"hierarchy.most_detailed_mip", 6}}).direction.values,
              trace(glossy, {{"hierarchy.most_detailed_mip", 5}}).direction.values);
}

/// Rays of all but mirrors start from the nearest depth of a texel, here of 4x4 pixels, and meet the surface as such
/// texels show it. The wall has one depth, so that there the first alone makes a difference.
TEST_F(DiligentHits, AreAsCoarseAsMostDetailedMipExceptForMirrors) {
    pose.world_from_view = glm::mat4(1);
    HostGBuffer mirror = gbuffer_of(floor_before_white);
    const float roughest_mirror = 2.0f / 255, smoothest_glossy = 3.0f / 255;  // as stored; a mirror's is below 0.01
    for (size_t i = 3; i < mirror.normal.values.size(); i += 4) mirror.normal.values[i] = roughest_mirror;
    const nlohmann::json coarse = {{"hierarchy.most_detailed_mip", 2}};
    EXPECT_EQ(trace(mirror, coarse).direction.values, trace(mirror).direction.values);

    HostGBuffer glossy = mirror;
    for (size_t i = 3; i < glossy.normal.values.size(); i += 4) glossy.normal.values[i] = smoothest_glossy;
    const DiligentTraced found = trace(glossy, coarse);
    unsigned rays = 0, wrong = 0, as_if_fine = 0;
    for (unsigned y = view.extent.y * 3 / 4; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) {
            if (found.radiance.pixel(x, y)[3] == 0) continue;
            const glm::dvec3 ray(found.direction.rgb(size_t(y) * view.extent.x + x));
            const unsigned nearest_row = y / 4 * 4 + 3;
            const auto length_from = [&](double depth) { return (-6 + depth) / glm::normalize(ray).z; };
            const auto depth_of_row = [&](unsigned row) {
                return double(view_distance(glossy.camera, *mirror.depth.pixel(x, row)));
            };
            ++rays;
            wrong += std::abs(glm::length(ray) - length_from(depth_of_row(nearest_row))) > 1e-3;
            as_if_fine += y != nearest_row && std::abs(glm::length(ray) - length_from(depth_of_row(y))) < 1e-3;
        }
    EXPECT_GT(rays, 1000u);
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(as_if_fine, 0u);
}

TEST_F(DiligentHits, AreFoundByAnOrthographicCamera) {
    pose.is_orthographic = true;
    pose.orthographic_height = 5;
    pose.world_from_view = glm::rotate(glm::translate(glm::mat4(1), {0, 2.5f, 3}), -0.5f, glm::vec3(1, 0.1f, 0.2f));
    const Quality found = quality({{"hierarchy.relative_depth_buffer_thickness", 0.5}});
    EXPECT_GT(found.rays, 2000u);
    EXPECT_GT(found.right, 0.99);
}

}  // namespace
