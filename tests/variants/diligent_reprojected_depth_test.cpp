#include "tests/variants/diligent_frames.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/variant_fixture.h"

#include <algorithm>

namespace {

struct DiligentReprojectedDepth : VariantTest {};

/// The device depth (not reversed) of a point at a distance from the camera plane.
float depth_at(const CameraPose& pose, float distance) {
    return pose.far / (pose.far - pose.near) * (1 - pose.near / distance);
}

/// Looks at a wall across the view, `distance` m before the camera, which came `approach` m nearer since the frame
/// before.
HostImage wall_seen_before(Device& device, float distance, float approach, const FrameView& view,
                           const nlohmann::json& parameters) {
    CameraPose before, now;
    now.world_from_view[3] = glm::vec4(0, 0, -approach, 1);
    const CameraData camera = camera_data(now, &before, view);
    DiligentFrames frames(device, view.extent, parameters);
    const GBuffer gbuffer = upload_gbuffer(frames.graph, now, camera, [&](const CameraRay& ray) {
        SyntheticHit hit;
        hit.distance = -distance / ray.direction.z;
        return hit;
    });
    frames.graph.begin_frame(camera, frames.parameters.params, gbuffer.images());
    return frames.graph.download(diligent_reprojected_depth(frames.graph, gbuffer));
}

TEST_F(DiligentReprojectedDepth, IsThatOfTheFrameBefore) {
    for (const float approach : {0.0f, 1.5f, -2.0f}) {
        const FrameView view{.extent = {33, 17}, .frame = 1, .jitter = {0.4f, -0.3f}};
        for (const float found : wall_seen_before(device(), 5.0f, approach, view, nlohmann::json::object()).values)
            EXPECT_NEAR(found, depth_at({}, 5.0f + approach), 1e-6f) << approach;  // the rounding of float32
    }
}

TEST_F(DiligentReprojectedDepth, OfPointsBehindThePreviousCameraIsTheNearPlaneIfGuarded) {
    const FrameView view{.extent = {33, 17}, .frame = 1};
    for (const bool is_guarded : {false, true}) {
        // The camera has backed away through the wall, which was 2 m behind it.
        const HostImage depth = wall_seen_before(device(), 3.0f, -5.0f, view, {{"guard_previous_clip", is_guarded}});
        for (const float found : depth.values)
            if (is_guarded)
                EXPECT_EQ(found, 0.0f);
            else
                EXPECT_NEAR(found, depth_at({}, -2.0f), 1e-5f);  // the mirrored point: beyond the far plane
    }
}

struct DiligentReprojectedDepthOf : VariantTest, testing::WithParamInterface<std::string> {};

TEST_P(DiligentReprojectedDepthOf, EqualsTheOriginals) {
    for (unsigned frame = 0; frame < diligent_frame_count(GetParam()); ++frame) {
        const HostGBuffer host = diligent_golden_frame(GetParam(), frame);
        DiligentFrames frames(device(), host.extent(), nlohmann::json::object());
        frames.begin(host);
        const HostImage found = frames.graph.download(diligent_reprojected_depth(frames.graph, frames.gbuffer));
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
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(DiligentReprojectedDepthOf);

}  // namespace
