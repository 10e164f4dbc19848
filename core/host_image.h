#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

/// An image on the CPU: float32, channels interleaved, rows from top to bottom. Colours are linear Rec.709 radiance.
struct HostImage {
    glm::uvec2 extent{0, 0};
    unsigned channels = 0;
    std::vector<float> values;  ///< extent.x * extent.y * channels

    HostImage() = default;
    HostImage(glm::uvec2 extent, unsigned channels, float value = 0.0f)
        : extent(extent), channels(channels), values(size_t(extent.x) * extent.y * channels, value) {}

    size_t pixel_count() const { return size_t(extent.x) * extent.y; }
    float* pixel(unsigned x, unsigned y) { return &values[(size_t(y) * extent.x + x) * channels]; }
    const float* pixel(unsigned x, unsigned y) const { return &values[(size_t(y) * extent.x + x) * channels]; }

    glm::vec3 rgb(size_t index) const {
        return {values[index * channels], values[index * channels + 1], values[index * channels + 2]};
    }
    void set_rgb(size_t index, glm::vec3 c) {
        for (int i = 0; i < 3; ++i) values[index * channels + i] = c[i];
    }
};

/// `count` channels from `first` on, as an image of their own; first + count <= image.channels.
inline HostImage channels_of(const HostImage& image, unsigned first, unsigned count) {
    HostImage part(image.extent, count);
    for (size_t i = 0; i < part.pixel_count(); ++i)
        for (unsigned c = 0; c < count; ++c) part.values[i * count + c] = image.values[i * image.channels + first + c];
    return part;
}
