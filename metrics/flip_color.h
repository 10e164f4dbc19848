#pragma once
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>

// The colour spaces of FLIP (Andersson et al. 2020, section 4.1), all relative to D65 as linear sRGB's white.

/// Linear RGB (BT.709, D65) to XYZ, divided by the XYZ of white (0.950428545, 1, 1.088900371).
inline glm::vec3 relative_xyz_from_linear(glm::vec3 c) {
    constexpr double x = 1.052156925 / 24577794, y = 1.0 / 12288897, z = 0.918357670 / 73733382;
    return {float(10135552 * x) * c.r + float(8788810 * x) * c.g + float(4435075 * x) * c.b,
            float(2613072 * y) * c.r + float(8788810 * y) * c.g + float(887015 * y) * c.b,
            float(1425312 * z) * c.r + float(8788810 * z) * c.g + float(70074185 * z) * c.b};
}

inline glm::vec3 linear_from_relative_xyz(glm::vec3 t) {
    const glm::vec3 c = t * glm::vec3(0.950428545f, 1.0f, 1.088900371f);
    return {3.241003275f * c.x - 1.537398934f * c.y - 0.498615861f * c.z,
            -0.969224334f * c.x + 1.875930071f * c.y + 0.041554224f * c.z,
            0.055639423f * c.x - 0.204011202f * c.y + 1.057148933f * c.z};
}

/// YCxCz, the space of the eye's contrast sensitivity, without its factors and offset: (Y + 16) / 116, Cx / 500, Cz /
/// 200. Linear filters give the same result, and small differences survive float32.
inline glm::vec3 opponent_from_linear(glm::vec3 c) {
    const glm::vec3 t = relative_xyz_from_linear(c);
    return {t.y, t.x - t.y, t.y - t.z};
}

inline glm::vec3 linear_from_opponent(glm::vec3 o) { return linear_from_relative_xyz({o.x + o.y, o.x, o.x - o.z}); }

/// Cube root for t in [1e-3, 2], to 1e-7: Halley's iteration after a guess from the exponent. Unlike the library's, it
/// can be vectorised.
inline float cube_root(float t) {
    const float guess = float(std::bit_cast<int32_t>(t)) * (1.0f / 3) + 709921077.0f;
    float r = std::bit_cast<float>(int32_t(guess));
    for (int i = 0; i < 2; ++i) {
        const float cube = r * r * r;
        r *= (cube + 2 * t) / (2 * cube + t);
    }
    return r;
}

/// CIELab, its a and b scaled by 0.01 L: Hunt's effect, by which dark colours look less saturated.
inline glm::vec3 hunt_lab_from_linear(glm::vec3 c) {
    constexpr float edge = 6.0f / 29;
    const auto f = [](float t) {
        const float root = cube_root(t > edge * edge * edge ? t : 1.0f);
        return t > edge * edge * edge ? root : t / (3 * edge * edge) + 4.0f / 29;
    };
    const glm::vec3 t = relative_xyz_from_linear(c);
    const float x = f(t.x), y = f(t.y), z = f(t.z);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

/// HyAB (Abasi, Tehran, Fairchild 2020): made for large differences of colour.
inline float hyab(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 d = a - b;
    return glm::abs(d.x) + glm::sqrt(d.y * d.y + d.z * d.z);
}
