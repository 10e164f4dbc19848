#include "tests/variants/denoiser_scene.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <optional>

// Where in the last frame's image the denoiser looks for history: of a wall at z = 0, whose history is a ramp that
// encodes its own place.

namespace {

constexpr glm::uvec2 extent{64, 48};
constexpr float ramp_start = 0.4f, ramp_rise = 0.2f;  // over the image; near the mean of checkered(), so plausible

glm::vec2 uv_in(const glm::mat4& clip_from_world, glm::vec3 point) {
    const glm::vec4 clip = clip_from_world * glm::vec4(point, 1);
    return 0.5f * glm::vec2(clip) / clip.w + 0.5f;
}

/// The wall as `camera` sees it. `reflected_at`: how far behind the wall each pixel sees its reflection (m). `expected`
/// receives where that was in the last frame's image (pixels).
DenoiserInputs wall_seen_by(const CameraPose& pose, const CameraData& camera, float reflected_at,
                            HostImage* expected = nullptr) {
    DenoiserInputs inputs = facing_wall({.extent = extent, .color = checkered});
    inputs.camera = camera;
    const glm::vec2 jitter(camera.jitter), jitter_before(camera.jitter.z, camera.jitter.w);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f + jitter);
            const float distance = -ray.origin.z / ray.direction.z;
            const glm::vec3 point = ray.origin + distance * ray.direction;
            const glm::vec4 clip = camera.clip_from_world * glm::vec4(point, 1);
            const glm::vec2 motion =
                uv_in(camera.clip_from_world, point) - uv_in(camera.previous_clip_from_world, point);
            *inputs.depth.pixel(x, y) = clip.z / clip.w;
            for (int i = 0; i < 2; ++i) inputs.motion.pixel(x, y)[i] = motion[i];
            inputs.radiance.pixel(x, y)[3] = reflected_at;
            if (!expected) continue;
            const glm::vec3 reflected = point + reflected_at * ray.direction;
            const glm::vec2 pixel =
                uv_in(camera.previous_clip_from_world, reflected) * glm::vec2(extent) - jitter_before;
            for (int i = 0; i < 2; ++i) expected->pixel(x, y)[i] = pixel[i];
        }
    return inputs;
}

/// Red is the column, green the row.
HostImage ramp() {
    HostImage image(extent, 4, 0.5f);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (int i = 0; i < 2; ++i)
                image.pixel(x, y)[i] = ramp_start + ramp_rise * (float(i == 0 ? x : y) + 0.5f) / float(extent[i]);
    return image;
}
float place_on_ramp(float value, int axis) { return (value - ramp_start) / ramp_rise * float(extent[axis]); }

struct AmdDenoiserReprojection : TechniqueTest {
    CameraPose before{.world_from_view = glm::translate(glm::mat4(1), {0, 0, 4}), .orthographic_height = 3};
    FrameView view{.extent = extent, .frame = 1};

    /// Compares where history is found with where the point that each pixel shows was, in pixels; or with where the
    /// point that far behind the wall was (m).
    void expect_true_history(const CameraPose& pose, float reflected_at, nlohmann::json parameters = {},
                             std::optional<float> looked_up_at = {}) {
        if (!parameters.contains("denoiser_form")) parameters["denoiser_form"] = "faithful";
        parameters["float_histories"] = true;
        HostImage expected(extent, 2);
        DenoiserInputs now =
            wall_seen_by(pose, camera_data(pose, &before, view), looked_up_at.value_or(reflected_at), &expected);
        for (size_t i = 0; i < now.radiance.pixel_count(); ++i) now.radiance.values[4 * i + 3] = reflected_at;
        const FrameView view_before{.extent = extent, .jitter = view.previous_jitter};
        const DenoiserInputs last = wall_seen_by(before, camera_data(before, nullptr, view_before), reflected_at);
        AmdDenoiserBench bench(device(), extent, parameters);
        bench.begin_frame(now, &last);
        bench.upload(bench.histories.radiance.previous, ramp());
        amd_reproject(bench.pass_list, bench.gbuffer, bench.work, bench.histories, bench.denoiser);
        const HostImage found = bench.pass_list.download(bench.reprojected());
        unsigned compared = 0;
        // The 9x9 pixels that history must resemble lie inside of the image.
        for (unsigned y = 4; y < extent.y - 4; ++y)
            for (unsigned x = 4; x < extent.x - 4; ++x) {
                const glm::vec2 pixel(expected.pixel(x, y)[0], expected.pixel(x, y)[1]);
                // Filtering is cut at the border.
                if (glm::any(glm::lessThan(pixel, glm::vec2(1))) ||
                    glm::any(glm::greaterThan(pixel, glm::vec2(extent) - 1.0f)))
                    continue;
                ++compared;
                for (int i = 0; i < 2; ++i)  // filters may have 8 bits for a place between two texels
                    EXPECT_NEAR(place_on_ramp(found.pixel(x, y)[i], i), pixel[i], 0.01f) << x << ", " << y;
            }
        EXPECT_GT(compared, extent.x * extent.y / 2);
    }
};

/// With its normals all alike, a wall's history is that of what it reflects; no cosine is above 1.
const nlohmann::json along_surface = {{"normal_similarity_threshold", 1.0}};

TEST_F(AmdDenoiserReprojection, FollowsTheJitter) {
    view.jitter = {0.3f, -0.2f};
    view.previous_jitter = {-0.4f, 0.1f};
    expect_true_history(before, 2);
    expect_true_history(before, 0, along_surface);
}

TEST_F(AmdDenoiserReprojection, FollowsTheReflectedPointOrTheSurface) {
    for (const bool is_orthographic : {false, true}) {
        SCOPED_TRACE(is_orthographic ? "orthographic" : "perspective");
        before.is_orthographic = is_orthographic;
        CameraPose pose = before;
        pose.world_from_view = glm::rotate(pose.world_from_view, 0.03f, glm::vec3(0.4f, 1, 0));
        expect_true_history(pose, 2);
        expect_true_history(pose, 0, along_surface);
    }
}

/// A camera that was behind the wall and looked at its back, so that what the wall reflects was behind it: the
/// projection puts that on the other side of the screen. The wall itself was before it.
TEST_F(AmdDenoiserReprojection, GuardPreviousClipDoesNotLookBehindTheCamera) {
    const CameraPose pose{.world_from_view = glm::translate(glm::mat4(1), {0, 0, 4})};
    before.world_from_view = glm::rotate(glm::translate(glm::mat4(1), {0, 0, -4}), 3.1f, glm::vec3(0, 1, 0));
    for (const char* form : {"faithful", "fast"})
        expect_true_history(pose, 10,
                            {{"guard_previous_clip", true}, {"reproject_history_depth", true}, {"denoiser_form", form}},
                            0.0f);
}

}  // namespace
