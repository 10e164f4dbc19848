#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

/// One number per pixel in double precision, rows from top to bottom: error maps, and what metrics are pooled from.
struct Plane {
    glm::uvec2 extent{0, 0};
    unsigned margin =
        0;  ///< pixels nearer to the border than this carry no value (the window of SSIM would leave the image)
    std::vector<double> values;

    Plane() = default;
    explicit Plane(glm::uvec2 extent) : extent(extent), values(size_t(extent.x) * extent.y) {}

    double* row(unsigned y) { return &values[size_t(y) * extent.x]; }
    const double* row(unsigned y) const { return &values[size_t(y) * extent.x]; }
    bool within_margin(size_t index) const {
        const size_t x = index % extent.x, y = index / extent.x;
        return x >= margin && y >= margin && x + margin < extent.x && y + margin < extent.y;
    }
};

/// The pixels that a number is computed over: nonzero is inside.
struct Mask {
    std::string name;
    glm::uvec2 extent{0, 0};
    std::vector<uint8_t> inside;

    size_t count() const {
        size_t n = 0;
        for (const uint8_t i : inside) n += i != 0;
        return n;
    }
};
