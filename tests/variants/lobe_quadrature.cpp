#include "tests/variants/lobe_quadrature.h"

using glm::dvec2, glm::dvec3;

std::string name_of(const LobeCase& c) {
    return std::string(c.lobe == lobe_of_normals ? "normals" : "visible normals") + ", roughness " +
           std::to_string(c.roughness) + ", view " + std::to_string(c.view_degrees) + ", bias " +
           std::to_string(c.bias);
}

bool is_left_by_truncation(const LobeCase& c, dvec3 m) {
    const double alpha = c.alpha(), tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z);
    if (c.lobe == lobe_of_normals) return c.bias == 0 || tan2 <= alpha * alpha * (1 - c.bias) / c.bias;
    const dvec3 o = c.o(), v = normalize(dvec3(alpha * o.x, alpha * o.y, o.z));
    const dvec3 n = normalize(dvec3(m.x / alpha, m.y / alpha, m.z)), on_cap = 2 * dot(v, n) * n - v;
    const dvec2 on_disk = dvec2(on_cap) / std::sqrt((1 + v.z) * (1 + on_cap.z)), mirror = -dvec2(v) / (1 + v.z);
    const double radius = std::sqrt(1 - double(c.bias));
    return length(on_disk - (1 - radius) * mirror) <= radius;
}

double lobe_normal_density(const LobeCase& c, dvec3 m) {
    if (!is_left_by_truncation(c, m)) return 0;
    const double a2 = double(c.alpha()) * c.alpha(), s = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
    const double distribution = a2 / (M_PI * s * s);
    if (c.lobe == lobe_of_normals) return distribution * m.z / (1 - c.bias);
    const dvec3 o = c.o();
    const double lambda = (-1 + std::sqrt(1 + a2 * (1 - o.z * o.z) / (o.z * o.z))) / 2;
    return distribution * std::max(0.0, dot(o, m)) / ((1 + lambda) * o.z) / (1 - c.bias);
}

dvec3 lobe_normal(const LobeCase& c, double share, double azimuth, double& solid_angle) {
    const double a2 = double(c.alpha()) * c.alpha(), tan2 = a2 * share / (1 - share);
    solid_angle = 0.5 * std::pow(1 + tan2, -1.5) * a2 / ((1 - share) * (1 - share)) * 2 * M_PI;
    const double z = 1 / std::sqrt(1 + tan2), r = std::sqrt(tan2) * z;
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}
