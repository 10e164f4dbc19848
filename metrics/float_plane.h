#pragma once
#include <cstddef>
#include <vector>

/// A rectangle of float32 values, for metrics whose filters would take twice as long in double precision.
struct FloatPlane {
    unsigned width = 0, height = 0;
    std::vector<float> values;

    FloatPlane() = default;
    FloatPlane(unsigned width, unsigned height) : width(width), height(height), values(std::size_t(width) * height) {}
    float* row(unsigned y) { return &values[std::size_t(y) * width]; }
    const float* row(unsigned y) const { return &values[std::size_t(y) * width]; }
};

/// `count` planes, which are not copied from one.
inline std::vector<FloatPlane> float_planes(std::size_t count, unsigned width, unsigned height) {
    std::vector<FloatPlane> planes;
    for (std::size_t i = 0; i < count; ++i) planes.emplace_back(width, height);
    return planes;
}
