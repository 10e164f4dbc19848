#include "metrics/disocclusion.h"
#include "core/error.h"
#include "core/shared/camera.h"
#include "metrics/masks.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

// A small ray caster draws rectangles that move: what a G-buffer would hold, exactly.

namespace {

constexpr glm::uvec2 extent(64, 48);
constexpr float near = 0.1f, far = 100.0f;

/// A rectangle in the xy plane of its own space, facing +z.
struct Rectangle {
    glm::mat4 world_from_object, previous_world_from_object;
    glm::vec2 half_size;
};

struct Shot {
    std::vector<Rectangle> scene;
    glm::mat4 world_from_view{1}, previous_world_from_view{1};
    glm::vec2 jitter{0}, previous_jitter{0};
    bool is_orthographic = false, is_reversed = false;
    float depth_steps = 0;  ///< device depth is rounded to 1 / depth_steps; 0: not
};

/// Height 2 at distance 1 (perspective), or 10 (orthographic).
glm::mat4 clip_from_view(const Shot& shot) {
    const float aspect = float(extent.x) / float(extent.y);
    glm::mat4 m(0);
    if (shot.is_orthographic) {
        m = glm::mat4(glm::vec4(1 / (5 * aspect), 0, 0, 0), glm::vec4(0, -0.2f, 0, 0),
                      glm::vec4(0, 0, -1 / (far - near), 0), glm::vec4(0, 0, -near / (far - near), 1));
        return m;
    }
    m[0][0] = 1 / aspect;
    m[1][1] = -1;
    m[2][3] = -1;
    m[2][2] = shot.is_reversed ? near / (far - near) : far / (near - far);
    m[3][2] = shot.is_reversed ? near * far / (far - near) : near * far / (near - far);
    return m;
}

CameraData camera_of(const Shot& shot) {
    CameraData c{};
    c.clip_from_view = clip_from_view(shot);
    c.view_from_clip = c.previous_view_from_clip = glm::inverse(c.clip_from_view);
    c.world_from_view = shot.world_from_view;
    c.view_from_world = glm::inverse(shot.world_from_view);
    c.previous_world_from_view = shot.previous_world_from_view;
    c.previous_view_from_world = glm::inverse(shot.previous_world_from_view);
    c.clip_from_world = c.clip_from_view * c.view_from_world;
    c.previous_clip_from_world = c.clip_from_view * c.previous_view_from_world;
    c.depth = {near, far, shot.is_reversed ? 0 : 1, shot.is_reversed};
    c.jitter = {shot.jitter, shot.previous_jitter};
    c.frame = {1, 0, shot.is_orthographic, 1};
    return c;
}

struct Hit {
    size_t object;
    glm::vec3 os_position;
    float depth;  ///< m along the view axis
};

std::optional<Hit> cast(const Shot& shot, bool is_previous, glm::vec2 uv) {
    const glm::mat4& world_from_view = is_previous ? shot.previous_world_from_view : shot.world_from_view;
    const glm::mat4 view_from_clip = glm::inverse(clip_from_view(shot));
    const glm::vec4 place = view_from_clip * glm::vec4(uv * 2.0f - 1.0f, 0.5f, 1);
    const glm::vec3 vs_start = shot.is_orthographic ? glm::vec3(place.x, place.y, 0) : glm::vec3(0);
    const glm::vec3 vs_ray = shot.is_orthographic ? glm::vec3(0, 0, -1) : glm::vec3(place) / -place.z;
    std::optional<Hit> nearest;
    for (size_t i = 0; i < shot.scene.size(); ++i) {
        const Rectangle& r = shot.scene[i];
        const glm::mat4 object_from_view =
            glm::inverse(is_previous ? r.previous_world_from_object : r.world_from_object) * world_from_view;
        const glm::vec3 start = object_from_view * glm::vec4(vs_start, 1),
                        ray = object_from_view * glm::vec4(vs_ray, 0);
        const float depth = -start.z / ray.z;
        const glm::vec3 hit = start + depth * ray;
        const bool is_inside = std::abs(hit.x) <= r.half_size.x && std::abs(hit.y) <= r.half_size.y;
        if (depth > near && depth < far && is_inside && (!nearest || depth < nearest->depth)) nearest = {i, hit, depth};
    }
    return nearest;
}

glm::vec2 uv_of(const glm::vec4& clip) { return glm::vec2(clip) / clip.w * 0.5f + 0.5f; }

struct Frame {
    CameraData camera;
    HostImage view_depth{extent, 1}, normal{extent, 3}, id{extent, 1}, motion{extent, 2};
    HostImage depth_before{extent, 1}, normal_before{extent, 3};
    HostImage id_before{extent, 1};
    float depth_step = 0;

    std::vector<uint8_t> mask() const {
        const PreviousFrame previous{camera, motion, depth_before, normal_before, depth_step};
        return disoccluded(view_depth, normal, id, previous);
    }
    size_t count() const { return size_t(std::ranges::count(mask(), 1)); }
};

glm::vec3 world_normal(const glm::mat4& world_from_object) { return glm::normalize(glm::vec3(world_from_object[2])); }

float device_depth(const Shot& shot, const CameraData& camera, float depth) {
    const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -depth, 1);
    const float exact = clip.z / clip.w;
    return shot.depth_steps > 0 ? std::round(exact * shot.depth_steps) / shot.depth_steps : exact;
}

Frame draw(const Shot& shot) {
    Frame f{.camera = camera_of(shot), .depth_step = shot.depth_steps > 0 ? 1 / shot.depth_steps : 0};
    const glm::vec2 size(extent);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t i = y * extent.x + x;
            const glm::vec2 centre(float(x) + 0.5f, float(y) + 0.5f), uv = (centre + shot.jitter) / size;
            glm::vec2 uv_before = uv;
            if (const std::optional<Hit> hit = cast(shot, false, uv)) {
                const Rectangle& r = shot.scene[hit->object];
                f.view_depth.values[i] = hit->depth;
                f.normal.set_rgb(i, world_normal(r.world_from_object));
                f.id.values[i] = float(hit->object + 1);
                const glm::vec4 before = r.previous_world_from_object * glm::vec4(hit->os_position, 1);
                uv_before = uv_of(f.camera.previous_clip_from_world * before);
            } else if (!shot.is_orthographic) {
                const glm::vec4 ray = f.camera.view_from_clip * glm::vec4(uv * 2.0f - 1.0f, 0.5f, 1);
                const glm::vec3 direction = glm::mat3(shot.world_from_view) * (glm::vec3(ray) / ray.w);
                uv_before = uv_of(f.camera.previous_clip_from_world * glm::vec4(direction, 0));
            }
            f.motion.values[2 * i] = uv.x - uv_before.x;
            f.motion.values[2 * i + 1] = uv.y - uv_before.y;

            f.depth_before.values[i] = f.camera.depth.z;
            if (const std::optional<Hit> hit = cast(shot, true, (centre + shot.previous_jitter) / size)) {
                f.depth_before.values[i] = device_depth(shot, f.camera, hit->depth);
                f.normal_before.set_rgb(i, world_normal(shot.scene[hit->object].previous_world_from_object));
                f.id_before.values[i] = float(hit->object + 1);
            }
        }
    return f;
}

glm::mat4 shifted(float x, float y, float z) {
    return {glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(x, y, z, 1)};
}
glm::mat4 turned_y(float degrees) {
    const float c = std::cos(degrees * float(M_PI) / 180), s = std::sin(degrees * float(M_PI) / 180);
    return {glm::vec4(c, 0, -s, 0), glm::vec4(0, 1, 0, 0), glm::vec4(s, 0, c, 0), glm::vec4(0, 0, 0, 1)};
}
/// Faces upwards.
glm::mat4 floor_at(float y) {
    return {glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, -1, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, y, 0, 1)};
}

Rectangle still(const glm::mat4& world_from_object, glm::vec2 half_size) {
    return {world_from_object, world_from_object, half_size};
}
const Rectangle wall = still(shifted(0, 0, -12), {1000, 1000});

/// How wide a pixel is at this distance, m: the screen is 2 m high at 1 m.
float pixel_at(float distance) { return 2 * distance / float(extent.y); }

/// A box's front, 16 x 10 pixels at 6 m, its border between pixel centres, that has moved by whole pixels.
Rectangle box_moved(float pixels_x, float pixels_y) {
    const float p = pixel_at(6);
    return {shifted(pixels_x * p, pixels_y * p, -6), shifted(0, 0, -6), {8 * p, 5 * p}};
}

}  // namespace

TEST(Disocclusion, AMovingBoxUncoversWhatWasBehindIt) {
    for (const bool is_reversed : {false, true}) {
        EXPECT_EQ(draw({.scene = {wall, box_moved(0, 0)}, .is_reversed = is_reversed}).count(), 0u);
        const Frame f = draw({.scene = {wall, box_moved(3, 0)}, .is_reversed = is_reversed});
        const std::vector<uint8_t> mask = f.mask();
        EXPECT_EQ(std::ranges::count(mask, 1), 3 * 10);
        for (size_t i = 0; i < mask.size(); ++i) EXPECT_EQ(mask[i], f.id.values[i] == 1 && f.id_before.values[i] == 2);
        // 2 columns and 4 rows of 16 x 10 pixels, with the corner once.
        EXPECT_EQ(draw({.scene = {wall, box_moved(2, -4)}, .is_reversed = is_reversed}).count(),
                  2u * 10 + 4 * 16 - 2 * 4);
    }
}

TEST(Disocclusion, TheMaskHoldsReflectivePixelsOnly) {
    const Frame f = draw({.scene = {wall, box_moved(3, 0)}});
    const PreviousFrame previous{f.camera, f.motion, f.depth_before, f.normal_before, f.depth_step};
    HostImage roughness(extent, 1, 0.1f), reflectance(extent, 3, 0.04f), confidence(extent, 1);
    const auto mask = [&] {
        return make_mask("disoccluded", {.view_depth = f.view_depth,
                                         .normal = f.normal,
                                         .material_id = f.id,
                                         .roughness = roughness,
                                         .reflectance = reflectance,
                                         .confidence = confidence,
                                         .previous = &previous});
    };
    EXPECT_EQ(mask().inside, f.mask());
    std::ranges::fill(roughness.values, 0.9f);
    EXPECT_EQ(mask().count(), 0u);
}

TEST(Disocclusion, ABoxBeforeTheSkyUncoversSky) { EXPECT_EQ(draw({.scene = {box_moved(3, 0)}}).count(), 3u * 10); }

TEST(Disocclusion, ASurfaceAtNearlyTheSameDepthIsToldByItsNormal) {
    const float p = pixel_at(5.93f);
    const glm::mat4 there = shifted(p / 2, 0, -5.93f);
    const Rectangle post{shifted(3 * p, 0, 0) * there, there, {p / 2, 5 * p}};  // one pixel wide, 10 high
    // 1.3 % behind where it was, and turned away.
    const Rectangle slanted = still(shifted(p / 2, 0, -6.01f) * turned_y(25), {1000, 1000});
    EXPECT_EQ(draw({.scene = {slanted, post}}).count(), 10u);
}

TEST(Disocclusion, JitteredSamplesAreLookedUpWhereTheyLie) {
    // The box ends 0.3 into column 40. Its neighbour at the centre of that column lay between the samples of two
    // columns, of which the first showed the box.
    Rectangle box = box_moved(0.3f, 0);
    box.previous_world_from_object = box.world_from_object;
    const Frame f = draw({.scene = {wall, box}, .previous_jitter = {-0.45f, 0}});
    EXPECT_EQ(f.id.values[24 * extent.x + 40], 1);
    EXPECT_EQ(f.id_before.values[24 * extent.x + 40], 2);
    EXPECT_EQ(f.count(), 0u);
}

TEST(Disocclusion, ABoxThatComesOutFromBehindAnotherIsNew) {
    const float p = pixel_at(3);
    const Rectangle curtain = still(shifted(-16 * p, 0, -3), {16 * p, 1000});  // the left half of the screen
    const Frame f = draw({.scene = {wall, box_moved(3, 0), curtain}});
    const std::vector<uint8_t> mask = f.mask();
    EXPECT_EQ(std::ranges::count(mask, 1), 3 * 10);
    for (size_t i = 0; i < mask.size(); ++i)
        EXPECT_EQ(mask[i], f.id.values[i] == 2 && i % extent.x >= 32 && i % extent.x < 35) << i;
}

TEST(Disocclusion, BoxesThatComeAndGoKeepTheirSurface) {
    const glm::vec2 half_size(1.5f, 1);
    const Rectangle at_five = still(shifted(0.3f, 0.1f, -5), half_size),
                    at_four = still(shifted(0.3f, 0.1f, -4), half_size);
    const Rectangle coming{at_four.world_from_object, at_five.world_from_object, half_size};
    const Rectangle going{at_five.world_from_object, at_four.world_from_object, half_size};
    // A fifth nearer or farther within a frame, far beyond the tolerance of a surface that stands still.
    EXPECT_EQ(draw({.scene = {wall, coming}}).count(), 0u);
    const Frame f = draw({.scene = {wall, going}});
    const std::vector<uint8_t> mask = f.mask();
    for (size_t i = 0; i < mask.size(); ++i) EXPECT_EQ(mask[i], f.id.values[i] == 1 && f.id_before.values[i] == 2) << i;
    EXPECT_GT(f.count(), 50u);
}

TEST(Disocclusion, AMirrorThatTurnsKeepsItsSurface) {
    const glm::mat4 pivot = shifted(0, 0, -6);
    for (const float angle : {0.0f, 30.0f, 50.0f}) {
        const Rectangle mirror{pivot * turned_y(angle), pivot * turned_y(angle - 6), {3, 2}};
        // It moves by up to 3 m x 6 degrees = 0.3 m, 5 % of its distance, and uncovers some of the wall.
        const Frame f = draw({.scene = {wall, mirror}});
        const std::vector<uint8_t> mask = f.mask();
        size_t tips = 0;
        for (size_t i = 1; i + 1 < mask.size(); ++i) {
            // At its corners a row is one pixel wide, and says nothing of the magnification.
            const bool is_tip = f.id.values[i] == 2 && f.id.values[i - 1] != 2 && f.id.values[i + 1] != 2;
            tips += is_tip;
            if (is_tip) continue;
            EXPECT_EQ(mask[i], f.id.values[i] == 1 && f.id_before.values[i] == 2) << angle << " " << i;
        }
        EXPECT_LE(tips, 2u);
    }
}

TEST(Disocclusion, AFloorToTheHorizonIsSeenAllAlong) {
    const Rectangle floor = still(floor_at(-1.6f), {1000, 1000});
    const glm::mat4 here = turned_y(20);
    for (const glm::vec3 step : {glm::vec3(0.4f, 0, 0), glm::vec3(0, 0.2f, 0), glm::vec3(0, 0, -0.5f)}) {
        const Frame f = draw({.scene = {floor},
                              .world_from_view = here * shifted(step.x, step.y, step.z),
                              .previous_world_from_view = here,
                              .jitter = {0.3f, -0.2f},
                              .previous_jitter = {-0.4f, 0.1f}});
        const std::vector<uint8_t> mask = f.mask();
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const size_t i = y * extent.x + x;
                const glm::vec2 uv = (glm::vec2(x, y) + 0.5f + glm::vec2(0.3f, -0.2f)) / glm::vec2(extent);
                const glm::vec2 before = uv - glm::vec2(f.motion.values[2 * i], f.motion.values[2 * i + 1]);
                const bool was_on_screen = before.x >= 0 && before.y >= 0 && before.x <= 1 && before.y <= 1;
                EXPECT_EQ(mask[i], !was_on_screen) << x << " " << y;
            }
    }
}

TEST(Disocclusion, NormalMapsAreNotTakenForOtherSurfaces) {
    const Rectangle box = box_moved(3, 0);
    Frame f = draw({.scene = {wall, box},
                    .world_from_view = shifted(0, 0.4f, 0),
                    .previous_world_from_view = shifted(0, 0.4f, 0)});
    const size_t expected = f.count();
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (HostImage* image : {&f.normal, &f.normal_before})
        for (size_t i = 0; i < image->pixel_count(); ++i)
            image->set_rgb(i, glm::normalize(glm::vec3(normal(random), normal(random), 2)));
    EXPECT_EQ(f.count(), expected);
}

TEST(Disocclusion, ACameraThatPassesAPillarSeesBehindIt) {
    // The wall shifts by 1 pixel, the pillar by 4: beside it 3 columns are new, and 1 at the border of the screen, save
    // where the pillar stands. It covers 8 columns.
    const float p = pixel_at(3);
    const Rectangle pillar = still(shifted(4 * p, 0, -3), {4 * p, 1000});
    const Frame f = draw({.scene = {wall, pillar}, .world_from_view = shifted(pixel_at(12), 0, 0)});
    EXPECT_EQ(f.count(), size_t(3 + 1) * extent.y);
    EXPECT_EQ(draw({.scene = {wall, pillar}, .world_from_view = shifted(-pixel_at(12), 0, 0)}).count(), 4u * extent.y);
}

TEST(Disocclusion, ATurningCameraSeesNewSkyAtTheBorder) {
    const Frame f = draw({.scene = {}, .world_from_view = turned_y(10)});  // to the left
    const std::vector<uint8_t> mask = f.mask();
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t i = y * extent.x + x;
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(extent);
            const glm::vec2 before = uv - glm::vec2(f.motion.values[2 * i], f.motion.values[2 * i + 1]);
            EXPECT_EQ(mask[i], before.x < 0 || before.y < 0 || before.y > 1) << x << " " << y;
        }
    EXPECT_GT(f.count(), 5u * extent.y);
}

TEST(Disocclusion, WhatWasBehindTheCameraIsNew) {
    EXPECT_EQ(draw({.scene = {}, .world_from_view = turned_y(180)}).count(), size_t(extent.x) * extent.y);
}

TEST(Disocclusion, OrthographicViews) {
    const float p = 10.0f / float(extent.y);
    const Rectangle box{shifted(3 * p, 0, -6), shifted(0, 0, -6), {8 * p, 5 * p}};
    EXPECT_EQ(draw({.scene = {wall, box}, .is_orthographic = true}).count(), 3u * 10);
    EXPECT_EQ(draw({.scene = {box}, .is_orthographic = true}).count(), 3u * 10);
}

TEST(Disocclusion, CoarseDepthIsNotTakenForAJump) {
    // At 60 m the step of a 16 bit depth is 60^2 / 0.1 / 2^16 = 0.55 m; the floor runs to 100 m.
    const Rectangle floor = still(floor_at(-1.6f), {1000, 1000});
    Frame f = draw({.scene = {floor}, .depth_steps = 65535});
    EXPECT_EQ(f.count(), 0u);
    size_t taken = 0;
    for (float distance = 80; distance < 95; ++distance) {
        f = draw({.scene = {still(shifted(0, 0, -distance), {1000, 1000})}, .depth_steps = 16383});
        EXPECT_EQ(f.count(), 0u) << distance;
        f.depth_step = 0;
        taken += f.count();
    }
    EXPECT_GT(taken, 0u);
}

TEST(Disocclusion, TheFirstFrameHasNone) {
    Frame f = draw({.scene = {wall, box_moved(3, 0)}});
    f.camera.frame.w = 0;
    EXPECT_EQ(f.count(), 0u);
}

TEST(Disocclusion, MistakesAreNamed) {
    Frame f = draw({.scene = {wall}});
    f.motion = HostImage(extent, 1);
    EXPECT_THROW(f.mask(), Error);
    f.motion = HostImage({3, 3}, 2);
    EXPECT_THROW(f.mask(), Error);
}
