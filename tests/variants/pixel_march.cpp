#include "tests/variants/pixel_march.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

/// Everything about one ray, by the distance along it (m).
struct Marched {
    const HostImage& depth;
    const CameraData& camera;
    const PixelRay& ray;
    double thickness;

    glm::dvec4 clip(double distance) const {
        return glm::dmat4(camera.clip_from_view) *
               glm::dvec4(glm::dvec3(ray.origin) + distance * glm::dvec3(ray.direction), 1);
    }
    /// Pixels of the G-buffer, whose samples lie beside the pixel centres of the screen.
    glm::dvec2 position(double distance) const {
        const glm::dvec4 c = clip(distance);
        return (glm::dvec2(c) / c.w * 0.5 + 0.5) * glm::dvec2(camera.extent) - glm::dvec2(camera.jitter);
    }
    double z(double distance) const { return double(ray.origin.z) + distance * double(ray.direction.z); }
    glm::dvec3 surface(glm::ivec2 pixel, double device_depth) const {
        const glm::dvec2 screen = glm::dvec2(pixel) + 0.5 + glm::dvec2(camera.jitter);
        const glm::dvec4 view = glm::dmat4(camera.view_from_clip) *
                                glm::dvec4(screen / glm::dvec2(camera.extent) * 2.0 - 1.0, device_depth, 1);
        return glm::dvec3(view) / view.w;
    }
};

/// Where the ray is farthest that it may be: at the near or far plane, or the border of the screen.
double reach_of(const Marched& marched) {
    const double dz = marched.ray.direction.z, z = marched.ray.origin.z;
    double reach = 1e5;
    if (dz > 0) reach = std::min(reach, (-double(marched.camera.depth.x) - z) / dz);
    if (dz < 0) reach = std::min(reach, (-double(marched.camera.depth.y) - z) / dz);
    const auto is_inside = [&](double distance) {
        const glm::dvec2 p = marched.position(distance);
        return p.x >= 0 && p.y >= 0 && p.x <= marched.camera.extent.x && p.y <= marched.camera.extent.y;
    };
    if (is_inside(reach)) return reach;
    double inside = 0, outside = reach;
    for (int i = 0; i < 200; ++i) (is_inside(0.5 * (inside + outside)) ? inside : outside) = 0.5 * (inside + outside);
    return inside;
}

/// The distance at which the position has this coordinate along `axis`.
double distance_at(const Marched& marched, int axis, double coordinate) {
    const glm::dmat4 m(marched.camera.clip_from_view);
    const glm::dvec4 a = m * glm::dvec4(glm::dvec3(marched.ray.origin), 1),
                     b = m * glm::dvec4(glm::dvec3(marched.ray.direction), 0);
    const double ndc = (coordinate + double(marched.camera.jitter[axis])) / double(marched.camera.extent[axis]) * 2 - 1;
    return (a[axis] - ndc * a.w) / (ndc * b.w - b[axis]);
}

/// Adds what the part of the ray between two distances finds in one pixel. True if it hits.
bool meets(const Marched& marched, glm::ivec2 pixel, double from, double to, double farthest_z,
           PixelMarchResult& result) {
    const double device_depth = *marched.depth.pixel(unsigned(pixel.x), unsigned(pixel.y));
    if (device_depth == double(marched.camera.depth.z)) return false;
    const glm::dvec3 surface = marched.surface(pixel, device_depth);
    const double behind_front = surface.z - farthest_z,
                 before_back = std::max(marched.z(from), marched.z(to)) - surface.z * (1 + marched.thickness);
    const double rounding = 2e-5 * std::abs(surface.z);  // a few units in the last place of device depth
    if (std::min(behind_front, before_back) > -rounding &&
        std::min(std::abs(behind_front), std::abs(before_back)) < rounding)
        result.is_close_call = true;
    if (behind_front < 0 || before_back < 0) return false;

    const double dz = marched.ray.direction.z;
    const double closest = dz == 0 ? from : std::clamp((surface.z - double(marched.ray.origin.z)) / dz, from, to);
    const glm::dvec3 normal(marched.ray.normal);
    const double height = glm::dot(surface - glm::dvec3(marched.ray.origin), normal);
    const double least = 0.5 * glm::dot(glm::dvec3(marched.ray.direction), normal) * closest;
    if (std::abs(height - least) < rounding) result.is_close_call = true;
    if (height < least) return false;
    result.is_hit = true;
    result.pixel = pixel;
    result.distance = closest;
    return true;
}

}  // namespace

PixelMarchResult march_every_pixel(const HostImage& depth, const CameraData& camera, const PixelRay& ray,
                                   double thickness) {
    const Marched marched{depth, camera, ray, thickness};
    const double reach = reach_of(marched);
    const glm::dvec2 start = marched.position(0), end = marched.position(reach);
    std::vector<double> walls{reach};
    for (int axis = 0; axis < 2; ++axis) {
        const double low = std::min(start[axis], end[axis]), high = std::max(start[axis], end[axis]);
        for (double wall = std::ceil(low); wall < high; ++wall) walls.push_back(distance_at(marched, axis, wall));
    }
    std::ranges::sort(walls);
    PixelMarchResult result;
    for (size_t i = 0; i + 1 < walls.size() && walls[i + 1] <= reach; ++i) {
        const glm::dvec2 middle = marched.position(0.5 * (walls[i] + walls[i + 1]));
        const glm::ivec2 pixel(glm::floor(middle));
        // A corner of a pixel, which rounding may miss or add.
        if (glm::distance(marched.position(walls[i]), marched.position(walls[i + 1])) < 1e-3)
            result.is_close_call = true;
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= int(depth.extent.x) || pixel.y >= int(depth.extent.y)) break;
        const double farthest_z = std::min(marched.z(walls[i]), marched.z(walls[i + 1]));
        if (meets(marched, pixel, walls[i], walls[i + 1], farthest_z, result)) break;
    }
    return result;
}

PixelMarchResult march_equal_steps(const HostImage& depth, const CameraData& camera, const PixelRay& ray,
                                   double thickness, unsigned steps, unsigned refinements) {
    const Marched marched{depth, camera, ray, thickness};
    const glm::dvec2 start = marched.position(0), line = marched.position(reach_of(marched)) - start;
    const int major = std::abs(line.x) >= std::abs(line.y) ? 0 : 1;
    const double length = std::abs(line[major]), sign = line[major] < 0 ? -1 : 1;
    PixelMarchResult result;
    const auto meets_at_end = [&](double from_pixels, double to_pixels) {
        const double from = distance_at(marched, major, start[major] + sign * from_pixels),
                     to = distance_at(marched, major, start[major] + sign * to_pixels);
        const glm::dvec2 position = marched.position(to);
        for (int axis = 0; axis < 2; ++axis) {
            const double wall = std::round(position[axis]);
            const bool is_border = wall <= 0 || wall >= depth.extent[axis];  // which nothing is beyond
            if (!is_border && std::abs(position[axis] - wall) < 1e-3) result.is_close_call = true;
        }
        const glm::ivec2 pixel =
            glm::clamp(glm::ivec2(glm::floor(position)), glm::ivec2(0), glm::ivec2(depth.extent) - 1);
        return pixel != ray.pixel && meets(marched, pixel, from, to, marched.z(to), result);
    };
    const double stride = std::max(length / steps, 1.0);
    double from = 0.5;
    for (unsigned step = 0; from < length && !result.is_hit; ++step) {
        double to = std::min((step + double(ray.jitter)) * stride, length);
        if (to <= from) continue;  // in its own pixel
        if (!meets_at_end(from, to)) {
            from = to;
            continue;
        }
        const double pixel = 1.01;
        for (unsigned i = 0; i < refinements && to - from > pixel; ++i) {
            if (to - from < pixel + 1e-3) result.is_close_call = true;
            const double middle = 0.5 * (from + to);
            (meets_at_end(from, middle) ? to : from) = middle;
        }
    }
    return result;
}
