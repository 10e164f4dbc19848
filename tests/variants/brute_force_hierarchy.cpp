#include "tests/variants/brute_force_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

glm::dvec3 view_from_screen(const CameraData& camera, glm::dvec3 position) {
    const glm::dvec2 ndc = 2.0 * glm::dvec2(position) / glm::dvec2(camera.extent) - 1.0;
    const glm::dvec4 view = glm::inverse(glm::dmat4(camera.clip_from_view)) * glm::dvec4(ndc, position.z, 1);
    return glm::dvec3(view) / view.w;
}

/// t at which the line is beyond the pixel `cell`.
double end_of_pixel(glm::dvec3 start, glm::dvec3 line, glm::dvec2 cell) {
    double t = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis)
        if (line[axis] != 0) t = std::min(t, (cell[axis] + (line[axis] > 0 ? 1 : 0) - start[axis]) / line[axis]);
    return t;
}

}  // namespace

glm::dvec3 screen_point(const CameraData& camera, glm::dvec3 vs_position) {
    const glm::dvec4 clip = glm::dmat4(camera.clip_from_view) * glm::dvec4(vs_position, 1);
    return {(glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(camera.extent), clip.z / clip.w};
}

glm::dvec3 view_point(const HostImage& depth, const CameraData& camera, glm::uvec2 pixel) {
    return view_from_screen(camera, {glm::dvec2(pixel) + 0.5, *depth.pixel(pixel.x, pixel.y)});
}

BruteForceEnd brute_force_end(const HostImage& depth, const CameraData& camera, glm::uvec2 origin,
                              glm::dvec3 direction) {
    const glm::dvec3 vs_origin = view_point(depth, camera, origin);
    const glm::dvec3 start(glm::dvec2(origin) + 0.5, *depth.pixel(origin.x, origin.y));
    const double step = 0.1 * -vs_origin.z;  // any that ends before the camera gives the same line
    const glm::dvec3 line = screen_point(camera, vs_origin + step * direction) - start;
    const double away = camera.depth.w == 1 ? -1 : 1;  // sign of depth that grows with distance
    const auto end_at = [&](double t, bool is_on_screen) {
        return BruteForceEnd{is_on_screen, glm::distance(view_from_screen(camera, start + t * line), vs_origin)};
    };
    const double beyond = 1e-6 / glm::length(glm::dvec2(line));  // a millionth of a pixel
    double t = end_of_pixel(start, line, glm::dvec2(origin));
    for (;;) {
        const glm::dvec2 cell = glm::floor(glm::dvec2(start + (t + beyond) * line));
        if (cell.x < 0 || cell.y < 0 || cell.x >= camera.extent.x || cell.y >= camera.extent.y) return end_at(t, false);
        const double surface = *depth.pixel(unsigned(cell.x), unsigned(cell.y));
        if (away * (surface - (start.z + t * line.z)) <= 0) return end_at(t, true);
        const double t_border = end_of_pixel(start, line, cell);
        const double t_surface = (surface - start.z) / line.z;
        if (away * line.z > 0 && t_surface < t_border) return end_at(t_surface, true);
        t = t_border;
    }
}
