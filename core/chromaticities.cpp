#include "core/chromaticities.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

constexpr Chromaticities cie_xyz{{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}};

bool are_near(const Chromaticities& a, const Chromaticities& b) {
    const auto is_near = [](glm::dvec2 p, glm::dvec2 q) {
        constexpr double tolerance = 0.001;
        return std::abs(p.x - q.x) <= tolerance && std::abs(p.y - q.y) <= tolerance;
    };
    return is_near(a.red, b.red) && is_near(a.green, b.green) && is_near(a.blue, b.blue) && is_near(a.white, b.white);
}

/// XYZ of a chromaticity, with X + Y + Z = 1: y may be 0, as that of two axes of CIE XYZ.
glm::dvec3 xyz_of(glm::dvec2 xy) { return {xy.x, xy.y, 1.0 - xy.x - xy.y}; }

/// Of XYZ under one white to XYZ under another.
glm::dmat3 bradford(glm::dvec2 from, glm::dvec2 to) {
    // Lindbloom, "Chromatic Adaptation"; rows are cone responses, glm's arguments columns.
    const glm::dmat3 cones(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
    const glm::dvec3 ratio = (cones * (xyz_of(to) / to.y)) / (cones * (xyz_of(from) / from.y));
    return glm::inverse(cones) * glm::dmat3(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z) * cones;
}

bool is_usable(const glm::dmat3& m) {
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(m[i][k]) < 1e6)) return false;
    return true;
}

}  // namespace

bool is_rec709(const Chromaticities& space) { return are_near(space, rec709_chromaticities); }

std::string name_of(const Chromaticities& space) {
    constexpr glm::dvec2 d65 = rec709_chromaticities.white, aces_white(0.32168, 0.33767);
    constexpr std::pair<const char*, Chromaticities> known[] = {
        {"Rec. 709", rec709_chromaticities},
        {"Rec. 2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65}},
        {"Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65}},
        {"DCI-P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
        {"ACES AP0", {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, aces_white}},
        {"ACES AP1", {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, aces_white}},
        {"Adobe RGB (1998)", {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, d65}},
        {"CIE XYZ", cie_xyz}};
    for (const auto& [name, values] : known)
        if (are_near(space, values)) return name;
    return "other primaries";
}

std::optional<glm::dmat3> xyz_from(const Chromaticities& space) {
    const glm::dmat3 primaries(xyz_of(space.red), xyz_of(space.green), xyz_of(space.blue));
    if (!is_usable(primaries) || !(std::abs(glm::determinant(primaries)) > 1e-6)) return {};
    const glm::dvec3 strength = glm::inverse(primaries) * (xyz_of(space.white) / space.white.y);
    if (!(std::min({strength.x, strength.y, strength.z}) > 0)) return {};
    const glm::dmat3 xyz(strength.x * primaries[0], strength.y * primaries[1], strength.z * primaries[2]);
    return is_usable(xyz) ? std::optional(xyz) : std::nullopt;
}

std::optional<glm::dmat3> rec709_from(const Chromaticities& space) {
    static const glm::dmat3 rec709_from_xyz = glm::inverse(*xyz_from(rec709_chromaticities));
    const std::optional<glm::dmat3> xyz = xyz_from(space);
    if (!xyz) return {};
    const glm::dmat3 adapted =
        are_near(space, cie_xyz) ? glm::dmat3(1) : bradford(space.white, rec709_chromaticities.white);
    const glm::dmat3 result = rec709_from_xyz * adapted * *xyz;
    return is_usable(result) ? std::optional(result) : std::nullopt;
}
