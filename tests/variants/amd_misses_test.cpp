#include "core/gbuffer/environment_images.h"
#include "tests/variants/amd_golden.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/technique_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

// What rays that meet nothing see: a mirror floor below nothing, whose exact reflections are known.

namespace {

struct AmdMisses : TechniqueTest {
    /// Turned about all axes, so that no row or column of the matrix stands in for another.
    CameraPose pose{.world_from_view = glm::rotate(glm::mat4(1), 0.6f, glm::vec3(0.5f, 1, 0.3f)),
                    .vertical_fov = 1.2f,
                    .near = 0.1f,
                    .far = 100.0f};
    const FrameView view{.extent = {64, 48}};

    /// `misses`: the parameter; with "weight" rays see the pixel's fallback, here of 0.25.
    void expect_environment(const Environment& environment, float ibl_factor, const std::string& misses = "fallback") {
        PassList pass_list(device(), view.extent);
        const CameraData camera = camera_data(pose, nullptr, view);
        const EnvironmentImages images(pass_list, environment, false);
        GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, floor_below_nothing);
        gbuffer.environment = &images;
        pass_list.upload(gbuffer.fallback, HostImage(view.extent, 4, 0.25f));
        const auto technique = make_technique(
            "amd_sssr",
            {{"denoise", false}, {"float_histories", true}, {"ibl_factor", ibl_factor}, {"misses", misses}});
        pass_list.begin_frame(camera, technique->params, gbuffer.images());
        const HostImage found = pass_list.download(technique->render(pass_list, gbuffer).radiance);
        unsigned floor_pixels = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(x, y) + 0.5f);
                const SyntheticHit hit = floor_below_nothing(ray);
                if (hit.metalness == 0) continue;
                ++floor_pixels;
                const glm::vec3 seen = misses == "fallback"
                                           ? environment.radiance(glm::reflect(ray.direction, hit.normal))
                                           : glm::vec3(0.25f);
                const glm::vec3 expected = ibl_factor * seen;
                for (int c = 0; c < 3; ++c)  // a chain of float32 matrices
                    EXPECT_NEAR(found.pixel(x, y)[c], expected[c], 1e-5f) << x << ", " << y;
            }
        EXPECT_GT(floor_pixels, 300u);
    }
};

/// Each channel varies along one oblique axis in its own way, and none is cut off at 0.
TEST_F(AmdMisses, SeeTheEnvironmentInTheDirectionOfTheirReflection) {
    const Environment gradient{.type = Environment::Type::gradient,
                               .color = {1, 1.5f, 2},
                               .slope = {0.9f, -1.2f, 0.4f},
                               .axis = glm::normalize(glm::vec3(0.7f, 0.3f, -0.5f))};
    for (const bool is_orthographic : {false, true}) {
        pose.is_orthographic = is_orthographic;
        pose.orthographic_height = 5;
        if (is_orthographic) pose.world_from_view = glm::rotate(pose.world_from_view, -0.7f, glm::vec3(1, 0, 0));
        for (const float ibl_factor : {1.0f, 0.4f})
            for (const char* misses : {"fallback", "weight"}) expect_environment(gradient, ibl_factor, misses);
    }
}

/// A G-buffer from files knows the environment only as each pixel's fallback.
TEST_F(AmdMisses, SeeTheFallbackOfTheirPixelInCaptures) {
    PassList pass_list(device(), view.extent);
    const CameraData camera = camera_data(pose, nullptr, view);
    HostGBuffer capture = download_gbuffer(pass_list, upload_gbuffer(pass_list, pose, camera, floor_below_nothing),
                                           camera, DepthFormat::d32f);
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x)
            capture.fallback.set_rgb(y * view.extent.x + x, {float(x), float(y), float((x * y) % 7)});
    for (const float ibl_factor : {1.0f, 0.5f}) {
        const HostImage found =
            amd_trace_frame(device(), capture, {{"ibl_factor", ibl_factor}, {"samples_per_quad", 4}},
                            HostImage({128, 128}, 2, 0.5f))
                .radiance;
        for (size_t i = 0; i < found.pixel_count(); ++i) {
            const bool is_floor = capture.depth.values[i] != 1;
            EXPECT_EQ(found.rgb(i), is_floor ? ibl_factor * capture.fallback.rgb(i) : glm::vec3(0)) << i;
        }
    }
}

}  // namespace
