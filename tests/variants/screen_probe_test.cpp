// The screen probe against scenes whose surroundings are known in every direction.
#include "core/gbuffer/environment_images.h"
#include "tests/variants/probe_lookup.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <random>

namespace {

const glm::vec3 up(0, 1, 0), ahead(0, 0, -1), behind(0, 0, 1), right(1, 0, 0);
const float infinite = std::numeric_limits<float>::infinity();

/// The camera stands in the middle.
constexpr float radius = 3;
SyntheticScene sphere(const std::function<glm::vec3(glm::vec3)>& lit) {
    return [=](const CameraRay& ray) {
        return SyntheticHit{.distance = radius, .normal = -ray.direction, .lit = lit(ray.direction)};
    };
}

/// Not alike in any two directions.
glm::vec3 color_of(glm::vec3 direction) { return 0.5f + 0.5f * direction; }

/// From one texel, 0.23 rad wide, to the next colours change by up to 0.115. What curvature and the means over texels
/// make of linear mixing is less than half of that; a map that is read half a texel off is not.
const float within_texels = 0.05f;

SyntheticHit background(const CameraRay&) { return {}; }

struct ScreenProbeTest : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    HostImage emission;       ///< rgb; none: black
    Environment environment;  ///< black
    float albedo = 0;
    PassList pass_list{device(), {64, 48}};
    ParameterSet none;
    ScreenProbe probe;

    void turn(float degrees, glm::vec3 axis) {
        pose.world_from_view = glm::rotate(glm::mat4(1), glm::radians(degrees), axis);
    }
    void show(const SyntheticScene& scene, bool has_previous = true) {
        const FrameView view{.extent = pass_list.extent(), .frame = frame_};
        const CameraData camera = camera_data(pose, has_previous && frame_ > 0 ? &before_ : nullptr, view);
        GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        environment_ = std::make_unique<EnvironmentImages>(pass_list, environment, false);
        gbuffer.environment = environment_.get();
        HostImage base_color(pass_list.extent(), 4);
        for (size_t i = 0; i < base_color.pixel_count(); ++i) base_color.set_rgb(i, glm::vec3(albedo));
        pass_list.upload(gbuffer.base_color, base_color);
        if (emission.pixel_count() > 0) pass_list.upload(gbuffer.emission, emission);
        pass_list.begin_frame(camera, none, gbuffer.images());
        probe = screen_probe(pass_list, gbuffer);
        ++frame_;
        before_ = pose;
    }
    /// All directions have been on the screen.
    void show_all_around(const SyntheticScene& scene) {
        pose.vertical_fov = 1.6f;  // more than a right angle
        for (const float degrees : {90.0f, -90.0f}) turn(degrees, right), show(scene);
        for (const float degrees : {270.0f, 180.0f, 90.0f, 0.0f}) turn(degrees, up), show(scene);
    }

    std::vector<glm::vec4> along(const std::vector<ProbeRay>& rays) { return look_up(pass_list, probe, rays); }
    glm::vec4 towards(glm::vec3 direction) { return along({{glm::vec3(0), glm::normalize(direction)}})[0]; }
    /// Of `count` directions, those for which `is_asked`.
    std::vector<ProbeRay> directions(unsigned count, const std::function<bool(glm::vec3)>& is_asked) {
        std::vector<ProbeRay> all;
        for (unsigned i = 0; i < count; ++i)
            if (const glm::vec3 direction = any_direction(); is_asked(direction)) all.push_back({{}, direction});
        return all;
    }
    glm::vec3 any_direction() {
        std::normal_distribution<float> normal;
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    }
    std::mt19937 random{1};

private:
    std::unique_ptr<EnvironmentImages> environment_;
    CameraPose before_;
    unsigned frame_ = 0;
};

/// Up to rounding of sums of 64 samples and 64 blocks.
TEST_F(ScreenProbeTest, AllThatIsClosedLooksAsItDoesOnTheScreen) {
    const glm::vec4 radiance(2, 3, 4, 1);
    for (const float degrees : {0.0f, 40.0f, 200.0f}) {
        turn(degrees, glm::normalize(glm::vec3(1, 2, 0.5f)));
        show(sphere([&](glm::vec3) { return glm::vec3(radiance); }), false);
        const HostImage surfaces = pass_list.download(probe.surfaces), nearness = pass_list.download(probe.nearness);
        for (size_t i = 0; i < surfaces.pixel_count(); ++i) {
            for (int c = 0; c < 4; ++c) ASSERT_NEAR(surfaces.values[4 * i + size_t(c)], radiance[c], 1e-4) << degrees;
            ASSERT_NEAR(nearness.values[i], 1 / radius, 1e-4) << degrees;
        }
    }
}

TEST_F(ScreenProbeTest, NothingIsGuessedFromNothing) {
    show(background);
    for (const float value : pass_list.download(probe.surfaces).values) ASSERT_EQ(value, 0);
    for (const float value : pass_list.download(probe.nearness).values) ASSERT_EQ(value, 0);
}

TEST_F(ScreenProbeTest, OfLampsOnlyWhatTheyReflectIsSpread) {
    emission = HostImage(pass_list.extent(), 4, 5);
    for (const float reflected : {0.0f, 2.0f}) {
        show(sphere([=](glm::vec3) { return glm::vec3(5 + reflected); }), false);
        const HostImage surfaces = pass_list.download(probe.surfaces);
        for (size_t i = 0; i < surfaces.values.size(); ++i)
            ASSERT_NEAR(surfaces.values[i], i % 4 == 3 ? 1 : reflected, 1e-4);
    }
}

/// Texels that were on the screen as a whole are kept to the bit.
TEST_F(ScreenProbeTest, RemembersWhatHasLeftTheScreen) {
    show(sphere(color_of));
    const std::vector<ProbeRay> seen = directions(
        8000, [](glm::vec3 d) { return d.z < 0 && std::abs(d.x) < -0.22f * d.z && std::abs(d.y) < -0.22f * d.z; });
    ASSERT_GT(seen.size(), 100u);
    const std::vector<glm::vec4> then = along(seen);
    for (size_t i = 0; i < seen.size(); ++i) {
        const glm::vec3 expected = color_of(seen[i].direction);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(then[i][c], expected[c], within_texels);
        ASSERT_NEAR(then[i].a, 1, 1e-5);
    }
    turn(90, up), show(sphere([](glm::vec3) { return glm::vec3(7); }));
    EXPECT_TRUE(along(seen) == then);
    EXPECT_NEAR(towards(-right).r, 7, 1e-4) << "what the screen shows now";

    turn(0, up), show(sphere([](glm::vec3) { return glm::vec3(9); }));
    for (const glm::vec4& again : along(seen)) ASSERT_NEAR(again.r, 9, 1e-4) << "until it is seen again";
    EXPECT_NEAR(towards(-right).r, 7, 1e-4);
    turn(90, up), show(background, false);
    for (const glm::vec4& forgotten : along(seen)) ASSERT_EQ(forgotten, glm::vec4(0));
}

/// A direction and its neighbour beyond an edge, 2e-4 rad away, differ by at most so many texels, 5e-3, of colours from
/// 0 to 1: the map is up to three times as dense there as its mean.
TEST_F(ScreenProbeTest, HasNoSeam) {
    show_all_around(sphere(color_of));
    std::vector<ProbeRay> rays;
    for (int i = 1; i < 400; ++i) {
        const float angle = glm::pi<float>() * float(i) / 400, across = 1e-4f;
        for (const float side : {across, -across}) {
            rays.push_back({{}, glm::normalize(glm::vec3(std::cos(angle), side, -std::sin(angle)))});
            rays.push_back({{}, glm::normalize(glm::vec3(side, std::cos(angle), -std::sin(angle)))});
        }
    }
    const std::vector<glm::vec4> found = along(rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::vec3 expected = color_of(rays[i].direction);
        const glm::vec4 beyond = found[i ^ 2];
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(found[i][c], expected[c], within_texels) << i;
            ASSERT_NEAR(found[i][c], beyond[c], 5e-3) << i;
        }
    }
}

/// Pixels that are no number are taken for open sky, those that are too bright for the largest of halves.
TEST_F(ScreenProbeTest, SpreadsNumbersAlone) {
    const float radiances[] = {2, std::nanf(""), infinite, -infinite, 2, -1, 2, 1e30f};
    unsigned pixel = 0;
    show(sphere([&](glm::vec3) { return glm::vec3(radiances[pixel++ % 8]); }));
    const HostImage surfaces = pass_list.download(probe.surfaces), nearness = pass_list.download(probe.nearness);
    for (size_t i = 0; i < surfaces.values.size(); ++i) {
        ASSERT_GE(surfaces.values[i], 0);
        ASSERT_LE(surfaces.values[i], i % 4 == 3 ? 1 : 65504);
    }
    for (const float value : nearness.values) ASSERT_NEAR(value, 1 / radius, 1e-4);
    EXPECT_NEAR(towards(ahead + 0.1f * up + 0.1f * right).a, 5.0f / 8, 0.15) << "three in eight are no numbers";
    show(sphere([](glm::vec3) { return glm::vec3(2); }));
    for (const glm::vec3 direction : {ahead, ahead + 0.2f * right}) {
        EXPECT_NEAR(towards(direction).r, 2, 1e-4) << "nothing of them stays";
        EXPECT_NEAR(towards(direction).a, 1, 1e-5);
    }
}

/// By brute force: where the ray meets the sphere. Seen from the middle, as if without parallax, the same colours are
/// far off.
TEST_F(ScreenProbeTest, RaysFromOtherPlacesSeeWhatTheyMeet) {
    show_all_around(sphere(color_of));
    std::vector<ProbeRay> rays;
    for (int i = 0; i < 2000; ++i) rays.push_back({0.9f * radius * any_direction(), any_direction()});
    const std::vector<glm::vec4> found = along(rays);
    double without_parallax = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 from(rays[i].from_camera), direction(rays[i].direction);
        double inside = 0, outside = 10 * radius;  // along the ray, which leaves the sphere between them
        for (int step = 0; step < 50; ++step) {
            const double middle = 0.5 * (inside + outside);
            (glm::length(from + middle * direction) < radius ? inside : outside) = middle;
        }
        const glm::vec3 expected = color_of(glm::vec3(glm::normalize(from + inside * direction)));
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[i][c], expected[c], within_texels) << i;
        without_parallax += glm::length(expected - color_of(rays[i].direction)) / double(rays.size());
    }
    EXPECT_GT(without_parallax, 5 * within_texels);
}

/// The camera stands on a floor without end; behind it nothing was ever seen. Within 20 degrees of the horizon either
/// is likely.
TEST_F(ScreenProbeTest, FloorsLieBelowAndTheSkyAbove) {
    const glm::vec3 of_floor(0.3f, 0.2f, 0.1f);
    show([&](const CameraRay& ray) {
        if (ray.direction.y > -0.02f) return SyntheticHit{};
        return SyntheticHit{.distance = 1.5f / -ray.direction.y, .normal = up, .lit = of_floor};
    });
    for (const ProbeRay& ray : directions(500, [](glm::vec3 d) { return std::abs(d.y) > 0.5f; })) {
        const glm::vec4 found = towards(ray.direction);
        if (ray.direction.y > 0) {
            EXPECT_LT(found.a, 0.1) << ray.direction.x << ", " << ray.direction.y << ", " << ray.direction.z;
        } else {
            EXPECT_GT(found.a, 0.9) << ray.direction.x << ", " << ray.direction.y << ", " << ray.direction.z;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / found.a, of_floor[c], 1e-4);
        }
    }
}

/// A red wall ahead on a green floor, below a blue ceiling; the same all around. With a window in the wall it stays
/// closed behind the camera.
TEST_F(ScreenProbeTest, WallsStandAround) {
    const SyntheticScene room = [](const CameraRay& ray) {
        const float to_wall = 4 / -ray.direction.z, to_plane = 1.5f / std::abs(ray.direction.y);
        if (to_plane < to_wall) {
            const bool is_floor = ray.direction.y < 0;
            return SyntheticHit{.distance = to_plane, .normal = is_floor ? up : -up, .lit = {0, is_floor, !is_floor}};
        }
        const bool is_window = std::abs(ray.direction.x + 0.2f) < 0.1f && std::abs(ray.direction.y) < 0.1f;
        return is_window ? SyntheticHit{} : SyntheticHit{.distance = to_wall, .normal = behind, .lit = {1, 0, 0}};
    };
    show(room);
    for (const glm::vec3 direction : {behind, right, -right, behind + right, behind - right}) {
        const glm::vec4 wall = towards(direction), floor = towards(direction - 2.0f * up),
                        ceiling = towards(direction + 2.0f * up);
        EXPECT_GT(wall.r, 0.5);
        EXPECT_GT(floor.g, 0.5);
        EXPECT_GT(ceiling.b, 0.5);
        for (const glm::vec4& found : {wall, floor, ceiling}) EXPECT_GT(found.a, 0.99);
    }
}

/// A wall before the camera, with nothing known of the other side. An environment of 2 makes an albedo of a half as
/// bright as 1: then nothing is behind the camera. Ten times darker walls are in its shadow, and ten times brighter
/// ones lit by lamps: then the wall is continued. In the first frame nothing is known of the environment.
TEST_F(ScreenProbeTest, IsOpenFromWhereTheEnvironmentLights) {
    environment.color = glm::vec3(2);
    albedo = 0.5f;
    for (const float lit : {0.1f, 1.0f, 10.0f}) {
        const auto wall = [=](const CameraRay& ray) {
            return SyntheticHit{.distance = radius / -ray.direction.z, .normal = behind, .lit = glm::vec3(lit)};
        };
        show(wall, false);
        EXPECT_NEAR(towards(behind).a, 1, 1e-3) << lit;
        show(wall);
        const bool is_open = lit == 1.0f;
        EXPECT_NEAR(towards(behind).a, is_open ? 0 : 1, 1e-3) << lit;
        EXPECT_NEAR(towards(behind).r, is_open ? 0 : lit, 1e-3 * lit) << lit;
        EXPECT_NEAR(towards(ahead).a, 1, 1e-3) << "what is seen is there";
    }
}

/// Of a gradient 2 + 1.5 cos about the axis that the wall faces a surface gets 2 + 2/3 * 1.5 over pi: half of that
/// is 1.5. A wall of 1.8 is within what the environment makes of it; by the mean light of all directions, 1, it would
/// not be.
TEST_F(ScreenProbeTest, KnowsFromWhereTheEnvironmentLights) {
    environment = {
        .type = Environment::Type::gradient, .color = glm::vec3(2), .slope = glm::vec3(1.5f), .axis = {0, 0, 1}};
    albedo = 0.5f;
    const auto wall = [=](const CameraRay& ray) {
        return SyntheticHit{.distance = radius / -ray.direction.z, .normal = behind, .lit = glm::vec3(1.8f)};
    };
    show(wall, false);
    show(wall);
    EXPECT_NEAR(towards(behind).a, 0, 1e-3);
}

}  // namespace
