#include "tests/variants/brute_force_march.h"

#include <algorithm>
#include <cmath>

namespace {

/// A ray in homogeneous pixel coordinates: xyw at distance t is a + t * b.
struct ScreenRay {
    glm::dvec3 a, b;
    double z, dz;  ///< view space

    glm::dvec2 at(double t) const {
        const glm::dvec3 h = a + t * b;
        return {h.x / h.z, h.y / h.z};
    }
    /// The distance at which pixel coordinate `axis` is `value`.
    double distance_at(int axis, double value) const { return (a[axis] - value * a.z) / (value * b.z - b[axis]); }
};

glm::dvec3 pixels_from_view(const CameraData& camera, glm::dvec4 position) {
    const glm::dvec4 clip = glm::dmat4(camera.clip_from_view) * position;
    return {0.5 * (clip.x + clip.w) * camera.extent.x, 0.5 * (clip.y + clip.w) * camera.extent.y, clip.w};
}

double view_z(const CameraData& camera, double device_depth) {
    const glm::dvec4 view = glm::dmat4(camera.view_from_clip) * glm::dvec4(0, 0, device_depth, 1);
    return view.z / view.w;
}

/// Where the ray ends: at its length, the near plane, or half a pixel inside of the screen's border.
double reach_of(const ScreenRay& ray, const CameraData& camera, double max_distance) {
    double reach = max_distance;
    if (ray.z + ray.dz * reach > -double(camera.depth.x))
        reach = std::max((-double(camera.depth.x) - ray.z) / ray.dz, 0.0);
    const auto is_inside = [&](double t) {
        const glm::dvec2 p = ray.at(t);
        return p.x >= 0.5 && p.y >= 0.5 && p.x <= camera.extent.x - 0.5 && p.y <= camera.extent.y - 0.5;
    };
    if (is_inside(reach)) return reach;
    double inside = 0, outside = reach;
    for (int i = 0; i < 200; ++i) (is_inside(0.5 * (inside + outside)) ? inside : outside) = 0.5 * (inside + outside);
    return inside;
}

}  // namespace

MarchResult brute_force_march(const HostImage& depth, const CameraData& camera, glm::vec3 origin, glm::vec3 direction,
                              const MarchSettings& s) {
    const ScreenRay ray{pixels_from_view(camera, glm::dvec4(glm::dvec3(origin), 1)),
                        pixels_from_view(camera, glm::dvec4(glm::dvec3(direction), 0)), origin.z, direction.z};
    const double reach = reach_of(ray, camera, s.max_distance);
    const glm::dvec2 start = ray.at(0), line = ray.at(reach) - start;
    const int major = std::abs(line.x) >= std::abs(line.y) ? 0 : 1;
    const double length = std::abs(line[major]), sign = line[major] < 0 ? -1 : 1;
    MarchResult result;
    result.is_close_call =
        std::abs(std::abs(line.x) - std::abs(line.y)) < 1e-3 && length > 1e-2;  // which axis is major
    const double first = s.interval_from_origin ? 0 : std::min(s.stride * std::max(s.jitter - 0.5, 0.0), length);
    double z_before =
        ray.z + ray.dz * (first > 0 ? std::min(ray.distance_at(major, start[major] + sign * first), reach) : 0);
    for (int i = 0;; ++i) {
        const double pixels = s.stride * (s.jitter + i);
        if (std::abs(pixels - length) < 2e-3) result.is_close_call = true;
        if (pixels > length) return result;
        const glm::dvec2 position = ray.at(ray.distance_at(major, start[major] + sign * pixels));
        const glm::dvec2 cell = position - glm::dvec2(camera.jitter.x, camera.jitter.y);
        for (int axis = 0; axis < 2; ++axis)
            if (std::abs(cell[axis] - std::round(cell[axis])) < 2e-3) result.is_close_call = true;
        const glm::ivec2 pixel(std::floor(cell.x), std::floor(cell.y));
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= int(depth.extent.x) || pixel.y >= int(depth.extent.y))
            return result;
        const double ahead = std::min(pixels + 0.5 * s.stride, length);
        const double z_after = ray.z + ray.dz * std::min(ray.distance_at(major, start[major] + sign * ahead), reach);
        const double device_depth = *depth.pixel(unsigned(pixel.x), unsigned(pixel.y));
        if (device_depth != double(camera.depth.z)) {
            const double scene = view_z(camera, device_depth), solid = s.thickness - s.relative_thickness * scene;
            const double front = scene - std::min(z_before, z_after),
                         back = std::max(z_before, z_after) - (scene - solid);
            const double rounding = 1e-4 * std::max(std::abs(scene), std::abs(z_after));
            if (std::min(front, back) > -rounding && std::min(std::abs(front), std::abs(back)) < rounding)
                result.is_close_call = true;
            if (front >= 0 && back >= 0) {
                result.is_hit = true;
                result.pixel = pixel;
                result.distance = ray.distance_at(major, start[major] + sign * pixels);
                return result;
            }
        }
        z_before = z_after;
    }
}
