// Where Frostbite's temporal filter looks history up.
#include "tests/variants/frostbite_filter_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

namespace {

/// What the mirror floor shows at a pixel: a point of the wall plane z = -6.
glm::vec3 mirrored_point(const CameraRay& ray) {
    const glm::vec3 p = ray.origin + mirror_floor(ray).distance * ray.direction,
                    d = ray.direction * glm::vec3(1, -1, 1);
    return p + (-6 - p.z) / d.z * d;
}

ResolvedPixel coordinates_seen(glm::uvec2, const CameraRay& ray) {
    if (mirror_floor(ray).metalness == 0) return {};
    const glm::vec3 p = ray.origin + mirror_floor(ray).distance * ray.direction, x = mirrored_point(ray);
    return {.radiance = {x.x + 50, x.y + 50, 1}, .ray_length = glm::length(x - p)};
}

struct FrostbiteReprojectionTest : FrostbiteFilterTest {
    bool is_floor(const CameraRay& ray) const { return mirror_floor(ray).metalness > 0; }

    /// Pixels that the point shown is away from the pixel's sample, for each floor pixel with a history of four texels.
    struct Offsets {
        std::vector<float> lengths;
        size_t lost = 0;  ///< pixels without
        float median() {
            std::ranges::nth_element(lengths, lengths.begin() + long(lengths.size() / 2));
            return lengths[lengths.size() / 2];
        }
    };

    glm::vec2 pixel_of(const CameraPose& camera, glm::vec3 point) const {
        const glm::vec4 clip = camera_data(camera, nullptr, view).clip_from_world * glm::vec4(point, 1);
        return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(view.extent);
    }

    /// Whether the camera saw nothing but the floor two pixels around.
    bool is_amid_floor(const CameraPose& camera, glm::vec2 place) const {
        for (int i = 0; i < 4; ++i) {
            const glm::vec2 corner = place + 2.0f * (glm::vec2(i & 1, i >> 1) * 2.0f - 1.0f);
            const bool is_inside = glm::all(glm::greaterThan(corner, glm::vec2(0))) &&
                                   glm::all(glm::lessThan(corner, glm::vec2(view.extent)));
            if (!is_inside || !is_floor(camera_ray(camera, view.extent, corner))) return false;
        }
        return true;
    }

    Offsets offsets(const CameraPose& before, const CameraPose& now, float length_scale) {
        FrostbiteFilterBench bench(device(), view, history_alone);
        bench.view.jitter = {0.4f, -0.3f};
        bench.next(before, mirror_floor, coordinates_seen);
        bench.view.jitter = view.jitter = {-0.2f, 0.45f};
        const HostImage found = bench.next(now, mirror_floor, [&](glm::uvec2 pixel, const CameraRay& ray) {
            return ResolvedPixel{.ray_length = length_scale * coordinates_seen(pixel, ray).ray_length};
        });
        Offsets offsets;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const CameraRay ray = ray_of(now, x, y);
                if (!is_floor(ray)) continue;
                const glm::vec3 image = glm::vec3(1, -1, 1) * mirrored_point(ray) - glm::vec3(0, 2, 0);
                if (!is_amid_floor(before, pixel_of(before, image))) continue;
                const float* shown = found.pixel(x, y);
                if (shown[2] == 0) {
                    ++offsets.lost;
                    continue;
                }
                const glm::vec3 seen(shown[0] / shown[2] - 50, -2 - (shown[1] / shown[2] - 50), -6);
                offsets.lengths.push_back(glm::length(pixel_of(now, seen) - glm::vec2(x, y) - 0.5f - view.jitter));
            }
        return offsets;
    }
};

/// Coordinates between two pixels are not linear in perspective: a tenth of a pixel at most. The floor itself moved by
/// many.
TEST_F(FrostbiteReprojectionTest, FollowsWhatAMirrorShows) {
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed})
        for (const bool is_orthographic : {false, true}) {
            SCOPED_TRACE(testing::Message() << is_orthographic << int(direction));
            view.depth_direction = direction;
            pose.is_orthographic = is_orthographic;
            pose.orthographic_height = 5;
            pose.world_from_view =
                glm::rotate(glm::translate(glm::mat4(1), {0, 2.5f, 3}), -0.5f, glm::vec3(1, 0.1f, 0));
            CameraPose before = pose;
            before.vertical_fov = 1.3f;
            before.orthographic_height = 5.5f;
            before.world_from_view = glm::translate(glm::mat4(1), glm::vec3(0.3f, 0.15f, -0.4f)) *
                                     glm::rotate(pose.world_from_view, 0.06f, glm::vec3(0.2f, 1, 0));
            Offsets reflected = offsets(before, pose, 1), surface = offsets(before, pose, 0);
            ASSERT_GT(reflected.lengths.size(), 1500u);
            EXPECT_LT(std::ranges::max(reflected.lengths), 0.1f);
            EXPECT_EQ(reflected.lost, 0u);
            EXPECT_GT(surface.median(), 1.0f);
        }
}

/// With the environment, misses show what is infinitely far away: directions.
TEST_F(FrostbiteReprojectionTest, FollowsTheEnvironmentAtInfinity) {
    nlohmann::json parameters = history_alone;
    parameters["misses"] = "fallback";
    FrostbiteFilterBench bench(device(), view, parameters);
    CameraPose before = pose;
    before.world_from_view = glm::translate(glm::mat4(1), glm::vec3(0.5f, 0.2f, 0)) *
                             glm::rotate(glm::mat4(1), 0.05f, glm::vec3(0, 1, 0.2f));
    const auto direction = [](glm::uvec2, const CameraRay& ray) {
        return ResolvedPixel{.radiance = ray.direction + 2.0f};
    };
    bench.next(before, mirror_floor, direction);
    const HostImage found =
        bench.next(pose, mirror_floor, [](glm::uvec2, const CameraRay&) { return ResolvedPixel{}; });
    const glm::vec3 before_eye = before.world_from_view[3];
    unsigned count = 0;
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) {
            const CameraRay ray = ray_of(pose, x, y);
            const float* shown = found.pixel(x, y);
            if (!is_floor(ray) || !is_amid_floor(before, pixel_of(before, before_eye + ray.direction))) continue;
            ++count;
            // A pixel is 0.02 wide; unit vectors between two pixels are nearly linear.
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c] - 2, ray.direction[c], 3e-4f);
        }
    EXPECT_GT(count, 1500u);
}

SyntheticHit plane_of_mirror(const CameraRay& ray) {
    SyntheticHit hit = wall_of_mirror(ray);
    hit.distance = (-5 - ray.origin.z) / ray.direction.z;
    return hit;
}

/// To an orthographic camera a mirror shows one direction, which is found wherever the surface was.
TEST_F(FrostbiteReprojectionTest, FollowsTheSurfaceThatShowsTheEnvironmentToAnOrthographicCamera) {
    pose.is_orthographic = true;
    pose.orthographic_height = 5;
    nlohmann::json parameters = history_alone;
    parameters["misses"] = "fallback";
    FrostbiteFilterBench bench(device(), view, parameters);
    CameraPose before = pose;
    before.world_from_view = glm::rotate(glm::translate(glm::mat4(1), {0.4f, 0.2f, 0}), 0.02f, glm::vec3(0, 1, 0.2f));
    bench.next(before, plane_of_mirror, [](glm::uvec2, const CameraRay& ray) {
        return ResolvedPixel{.radiance = ray.origin + plane_of_mirror(ray).distance * ray.direction + 10.0f};
    });
    const HostImage found =
        bench.next(pose, plane_of_mirror, [](glm::uvec2, const CameraRay&) { return ResolvedPixel{}; });
    unsigned count = 0;
    for (unsigned y = 8; y < view.extent.y - 8; ++y)
        for (unsigned x = 8; x < view.extent.x - 8; ++x) {
            const CameraRay ray = ray_of(pose, x, y);
            const glm::vec3 point = ray.origin + plane_of_mirror(ray).distance * ray.direction;
            ++count;
            // Linear in the place; a pixel is 0.08 wide, and places are known to 1e-3 of it.
            for (int c = 0; c < 2; ++c) ASSERT_NEAR(found.pixel(x, y)[c] - 10, point[c], 1e-3f) << x << ", " << y;
        }
    EXPECT_GT(count, 3000u);
}

/// Half a pixel to the side each place lies between two columns, one of which was too rough to be the same reflector.
TEST_F(FrostbiteReprojectionTest, CountsTheTexelsThatAreLeftWhole) {
    const float slope = 2 * std::tan(pose.vertical_fov / 2) / float(view.extent.y);  // of one pixel
    const SyntheticScene every_other_column = [slope](const CameraRay& ray) {
        SyntheticHit hit = wall_of_mirror(ray);
        if (int(std::floor(-ray.direction.x / ray.direction.z / slope)) % 2 != 0) hit.roughness += 0.3f;
        return hit;
    };
    CameraPose before = pose;
    before.world_from_view = glm::translate(glm::mat4(1), {5 * slope / 2, 0, 0});
    FrostbiteFilterBench bench(device(), view, history_alone);
    bench.next(before, every_other_column, [](glm::uvec2, const CameraRay&) {
        return ResolvedPixel{.radiance = glm::vec3(3, 2, 1), .confidence = 0.5f};
    });
    const HostImage found =
        bench.next(pose, wall_of_mirror, [](glm::uvec2, const CameraRay&) { return ResolvedPixel{.confidence = 0}; });
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 1; x + 1 < view.extent.x; ++x) {
            // A dozen roundings of float32, 6e-8 each, of 3 at most.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(found.pixel(x, y)[c], float(3 - c), 1e-5f) << x << ", " << y;
            ASSERT_NEAR(found.pixel(x, y)[3], 0.5f, 1e-5f) << x << ", " << y;
        }
}

}  // namespace
