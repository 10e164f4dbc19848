// The rung `on_screen` against what a perfect technique would look up in a reference's own images: mirror rays,
// projected to pixels, with the depth and the material there deciding what is shown.
#include "core/scene/load_scene.h"
#include "groundtruth/paths/traced_scene.h"
#include "groundtruth/reference/reference.h"

#include <gtest/gtest.h>
#include <cmath>
#include <optional>

namespace {

constexpr glm::uvec2 extent(160, 90);

struct Pixel {
    unsigned x, y;
};

/// The pixel that shows a point of a surface which faces the camera, if the reference's depth and material say so.
std::optional<Pixel> shown_at(const Reference& reference, const CameraData& camera, glm::vec3 point,
                              unsigned material) {
    const glm::vec4 clip = camera.clip_from_world * glm::vec4(point, 1.0f);
    const glm::vec2 uv = glm::vec2(clip) / clip.w * 0.5f + 0.5f;
    if (clip.w <= 0 || uv.x < 0 || uv.y < 0 || uv.x >= 1 || uv.y >= 1) return {};
    const Pixel pixel{unsigned(uv.x * float(extent.x)), unsigned(uv.y * float(extent.y))};
    const float distance = -(camera.view_from_world * glm::vec4(point, 1.0f)).z;
    const bool is_nearest = std::abs(*reference.depth.pixel(pixel.x, pixel.y) - distance) < 0.05f * distance;
    return is_nearest && *reference.material_id.pixel(pixel.x, pixel.y) == float(material + 1) ? std::optional(pixel)
                                                                                               : std::nullopt;
}

struct Agreement {
    int shown = 0, hidden = 0, agreeing = 0;
};

/// Looks each mirror pixel's reflection up and compares it with the rung.
Agreement look_up(const Scene& scene, const ScenePose& pose, const CameraPose& camera_pose) {
    const Reference reference = render_reference(scene, pose, camera_pose, extent, {.max_samples = 64, .ladder = true});
    const CameraData camera = camera_data(camera_pose, nullptr, {.extent = extent});
    const TracedScene traced(scene, pose, CameraView(camera_pose, extent), {});
    Agreement result;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t i = size_t(y) * extent.x + x;
            if (reference.ladder.reflectance.rgb(i) == glm::vec3(0.0f)) continue;
            if (scene.materials[size_t(reference.material_id.values[i]) - 1].roughness > 0.05f) continue;
            const CameraRay view = camera_ray(camera_pose, extent, {float(x) + 0.5f, float(y) + 0.5f});
            const float cosine = -glm::dot(view.direction, glm::vec3(camera_pose.world_from_view[2]));
            const glm::vec3 position = view.origin + view.direction * (reference.depth.values[i] / cosine);
            const glm::vec3 normal = reference.normal.rgb(i), direction = glm::reflect(view.direction, normal);

            glm::vec3 expected = reference.ladder.fallback.rgb(i);
            RTCRayHit ray;
            std::optional<Pixel> pixel;
            if (intersect(traced.geometry.handle(), position + 1e-3f * reference.geometric_normal.rgb(i), direction,
                          ray)) {
                const SurfacePoint met = traced.geometry.point(ray.hit.instID[0], ray.hit.primID, ray.hit.u, ray.hit.v);
                const glm::vec3 side = glm::dot(met.front_normal, direction) < 0 ? met.front_normal : -met.front_normal;
                if (glm::dot(side, view.origin - met.position) > 0)
                    pixel =
                        shown_at(reference, camera, met.position, traced.geometry.instance(ray.hit.instID[0]).material);
            }
            if (pixel) expected = reference.diffuse.mean.rgb(size_t(pixel->y) * extent.x + pixel->x);
            (pixel ? result.shown : result.hidden) += 1;
            const glm::vec3 rung = reference.ladder.on_screen.mean.rgb(i);
            // Light varies within a pixel and both have noise of 64 samples.
            result.agreeing += glm::length(rung - expected) <= 0.1f * glm::length(expected) + 1e-3f;
        }
    return result;
}

}  // namespace

TEST(ladder_lookup, finds_on_screen_what_the_images_of_the_reference_show) {
    for (const char* name : {"offscreen_mirror", "curved_mirror", "border_crossing"}) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name, {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"});
        const ScenePose pose = pose_scene(scene, 0);
        const Agreement found = look_up(scene, pose, pose_camera(scene.cameras.front(), pose, 0));
        const int pixels = found.shown + found.hidden;
        EXPECT_GT(found.shown, pixels / 20);
        EXPECT_GT(found.hidden, pixels / 20);
        // The rest are edges, which a pixel shows one side of.
        EXPECT_GT(found.agreeing, 0.97 * pixels) << found.shown << " shown, " << found.hidden << " hidden";
    }
}
