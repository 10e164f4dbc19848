#include "experiments/study/measuring/reflection_probe.h"

#include "core/shared/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

constexpr unsigned face_side = 32, probe_samples = 64, probe_guide_samples = 16;
constexpr glm::uvec2 latlong_extent(4 * face_side, 2 * face_side);

/// One side of a cube around the probe.
struct Face {
    glm::mat3 world_from_view;
    HostImage radiance;  ///< RGB
};

/// A view along `forward`, one of the axes.
glm::mat3 looking_along(glm::vec3 forward) {
    const glm::vec3 up = forward.y == 0 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 right = glm::cross(forward, up);
    return {right, up, -forward};
}

/// Where a direction in the view of a face meets it, between the centres of its pixels.
glm::vec3 radiance_along(const Face& face, glm::vec3 vs_direction) {
    const glm::vec2 on_plane = glm::vec2(vs_direction.x, -vs_direction.y) / -vs_direction.z;  // y down
    const float last = float(face_side - 1);
    const glm::vec2 at = glm::clamp((on_plane * 0.5f + 0.5f) * float(face_side) - 0.5f, 0.0f, last);
    const glm::uvec2 low = glm::min(glm::uvec2(at), glm::uvec2(face_side - 2));
    const glm::vec2 share = at - glm::vec2(low);
    const auto pixel = [&](unsigned x, unsigned y) { return face.radiance.rgb(size_t(y) * face_side + x); };
    return glm::mix(glm::mix(pixel(low.x, low.y), pixel(low.x + 1, low.y), share.x),
                    glm::mix(pixel(low.x, low.y + 1), pixel(low.x + 1, low.y + 1), share.x), share.y);
}

/// The face that `direction` meets.
glm::vec3 radiance_along(const std::array<Face, probe_views>& faces, glm::vec3 direction) {
    const auto depth = [&](const Face& face) { return -glm::dot(face.world_from_view[2], direction); };
    const Face& met = *std::ranges::max_element(faces, {}, depth);
    return radiance_along(met, glm::transpose(met.world_from_view) * direction);
}

}  // namespace

Environment reflection_probe(glm::vec3 position, const ReferenceSettings& settings, const ProbeView& render) {
    const std::array<glm::vec3, probe_views> axes = {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    ReferenceSettings of_face{.max_samples = probe_samples,
                              .max_depth = settings.max_depth,
                              .guide_samples = probe_guide_samples,
                              .keep_all = settings.keep_all};
    // A reference of one of these seeds would draw the same samples as the probe: of it the next six.
    const bool is_taken = settings.seed - first_probe_seed < probe_views;  // unsigned: not of seeds below
    const unsigned first_seed = first_probe_seed + (is_taken ? probe_views : 0);
    std::array<Face, probe_views> faces;
    for (size_t i = 0; i < faces.size(); ++i) {
        faces[i].world_from_view = looking_along(axes[i]);
        CameraPose camera{.vertical_fov = float(std::numbers::pi / 2),  // a probe has no planes
                          .near = 0.0f,
                          .far = std::numeric_limits<float>::infinity()};
        camera.world_from_view = glm::mat4(faces[i].world_from_view);
        camera.world_from_view[3] = glm::vec4(position, 1.0f);
        of_face.seed = first_seed + unsigned(i);
        faces[i].radiance = render(camera, glm::uvec2(face_side), of_face).image.mean;
    }
    Environment probe{.type = Environment::Type::image, .latlong = HostImage(latlong_extent, 3)};
    for (unsigned y = 0; y < latlong_extent.y; ++y)
        for (unsigned x = 0; x < latlong_extent.x; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(latlong_extent);
            probe.latlong.set_rgb(size_t(y) * latlong_extent.x + x,
                                  radiance_along(faces, environment_direction(uv, probe.rotation)));
        }
    return probe;
}
