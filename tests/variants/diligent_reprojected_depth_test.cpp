#include "tests/variants/diligent_frames.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace {

struct DiligentReprojectedDepth : TechniqueTest {};

/// The device depth (not reversed) of a point at a distance from the camera plane.
float depth_at(const CameraPose& pose, float distance) {
    return pose.far / (pose.far - pose.near) * (1 - pose.near / distance);
}

/// A wall across the view, seen by a camera that stood elsewhere the frame before.
struct SeenWall {
    CameraPose before, now;
    float distance;  ///< from now's plane (m)
    FrameView view{.extent = {33, 17}, .frame = 1};

    SyntheticHit hit(const CameraRay& ray) const {
        SyntheticHit hit;
        hit.distance = distance / dot(ray.direction, -glm::vec3(now.world_from_view[2]));
        return hit;
    }
    HostImage reprojected(Device& device, const nlohmann::json& parameters) const {
        const CameraData camera = camera_data(now, &before, view);
        DiligentFrames frames(device, view.extent, parameters);
        const GBuffer gbuffer =
            upload_gbuffer(frames.pass_list, now, camera, [&](const CameraRay& ray) { return hit(ray); });
        frames.pass_list.begin_frame(camera, frames.parameters.params, gbuffer.images());
        return frames.pass_list.download(diligent_reprojected_depth(frames.pass_list, gbuffer));
    }
};

/// The camera turns, so that depth before depends on where a pixel's sample lies, and on its jitter.
TEST_F(DiligentReprojectedDepth, IsThatOfTheFrameBefore) {
    SeenWall wall{.before = {}, .now = {}, .distance = 5.0f};
    wall.before.world_from_view = rotate(glm::mat4(1), 0.4f, glm::vec3(0, 1, 0));
    wall.before.world_from_view[3] = glm::vec4(0.3f, -0.2f, 1.5f, 1);
    wall.view.jitter = {0.4f, -0.3f};
    const HostImage found = wall.reprojected(device(), nlohmann::json::object());
    for (unsigned y = 0; y < 17; ++y)
        for (unsigned x = 0; x < 33; ++x) {
            const CameraRay ray = camera_ray(wall.now, wall.view.extent, glm::vec2(x, y) + 0.5f + wall.view.jitter);
            const glm::vec3 point = ray.origin + wall.hit(ray).distance * ray.direction;
            const float distance = -(inverse(wall.before.world_from_view) * glm::vec4(point, 1)).z;
            EXPECT_NEAR(*found.pixel(x, y), depth_at(wall.before, distance), 1e-6f);  // the rounding of float32
        }
}

TEST_F(DiligentReprojectedDepth, OfPointsBehindThePreviousCameraIsTheNearPlaneIfGuarded) {
    SeenWall wall{.before = {}, .now = {}, .distance = 3.0f};
    wall.now.world_from_view[3].z = 5.0f;  // backed away through the wall, which was 2 m behind the camera
    for (const float found : wall.reprojected(device(), {{"guard_previous_clip", true}}).values) EXPECT_EQ(found, 0.0f);
    for (const float found : wall.reprojected(device(), {{"guard_previous_clip", false}}).values)
        EXPECT_NEAR(found, depth_at(wall.before, -2.0f), 1e-5f);  // mirrored: beyond the far plane
}

struct DiligentReprojectedDepthOf : TechniqueTest, testing::WithParamInterface<std::string> {};

TEST_P(DiligentReprojectedDepthOf, EqualsTheOriginals) {
    for (unsigned frame = 0; frame < diligent_frame_count(GetParam()); ++frame) {
        const HostGBuffer host = diligent_golden_frame(GetParam(), frame);
        DiligentFrames frames(device(), host.extent(), nlohmann::json::object());
        frames.begin(host);
        const HostImage found = frames.pass_list.download(diligent_reprojected_depth(frames.pass_list, frames.gbuffer));
        const std::string file = diligent_frame_folder(GetParam(), frame) + "aux.exr";
        const LayeredImage golden = read_golden(file);
        const HostImage& expected = golden_layer(golden, "rpdepth");
        float worst = 0;
        for (size_t i = 0; i < found.values.size(); ++i)
            worst = std::max(worst, std::abs(found.values[i] - expected.values[i]));
        EXPECT_LE(worst, 1e-6f) << file;  // "compare" of the index
    }
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_reprojected_depth, DiligentReprojectedDepthOf,
                         testing::ValuesIn(diligent_sets_with("f0/aux.exr")),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
