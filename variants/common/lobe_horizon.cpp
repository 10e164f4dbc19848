#include "variants/common/lobe_horizon.h"

#include "variants/common/ggx_lobe.h"

#include <algorithm>

using glm::dvec2, glm::dvec3;

namespace {

/// Both lobes are images of the unit disk with equal shares for equal areas, and truncation draws that disk together
/// towards the place of the normal that mirrors the viewer (ggx_lobe.h).
struct Disk {
    unsigned lobe;
    double alpha;
    dvec3 v;       ///< the viewer, stretched
    dvec2 mirror;  ///< place of the normal +z

    Disk(unsigned lobe, dvec3 o, double alpha)
        : lobe(lobe),
          alpha(alpha),
          v(normalize(dvec3(alpha * o.x, alpha * o.y, o.z))),
          mirror(lobe == lobe_of_visible_normals ? -dvec2(v) / (1 + v.z) : dvec2(0)) {}

    /// Of the normal (slope, 1).
    dvec2 place(dvec2 slope) const {
        if (lobe == lobe_of_normals) return slope / std::sqrt(alpha * alpha + dot(slope, slope));
        const dvec3 n = normalize(dvec3(slope / alpha, 1)), on_cap = 2 * dot(v, n) * n - v;
        return dvec2(on_cap) / std::sqrt((1 + v.z) * (1 + on_cap.z));
    }

    /// From the mirror's place to the rim, along a unit vector.
    double to_rim(dvec2 direction) const {
        const double b = dot(mirror, direction);
        return -b + std::sqrt(std::max(0.0, b * b + 1 - dot(mirror, mirror)));
    }
};

}  // namespace

double share_below_horizon(unsigned lobe, double mu_o, double alpha, double bias) {
    const double sin_o = std::sqrt(std::max(0.0, 1 - mu_o * mu_o)), tan_o = sin_o / mu_o, kept = std::sqrt(1 - bias);
    const Disk disk(lobe, {sin_o, 0, mu_o}, alpha);
    // The viewer is mirrored to the horizon by normals whose slopes lie on a circle about (tan, 0) of the radius 1 /
    // cos, along `azimuth` as far from the mirror's as this:
    const auto horizon = [&](double azimuth) {
        const double b = tan_o * std::cos(azimuth), root = std::sqrt(b * b + 1);
        const double slope = b > 0 ? b + root : 1 / (root - b);
        return disk.place(slope * dvec2(std::cos(azimuth), std::sin(azimuth))) - disk.mirror;
    };
    // Half of the disk, in sectors about the mirror's place; the other half mirrors it.
    const int sectors = 256;
    double above = 0;
    dvec2 from = horizon(0);
    for (int i = 1; i <= sectors; ++i) {
        const dvec2 to = horizon(M_PI * i / sectors), middle = 0.5 * (from + to);
        const double angle = std::atan2(from.x * to.y - from.y * to.x, dot(from, to));
        const double radius = std::min(length(middle), kept * disk.to_rim(normalize(middle)));
        above += 0.5 * radius * radius * angle;
        from = to;
    }
    return std::clamp(1 - above / (0.5 * M_PI * kept * kept), 0.0, 1.0);
}
