#include "core/shared/environment.h"
#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace {
/// Bilinear between texel centres; u wraps, v clamps.
glm::vec3 bilinear(const HostImage& image, glm::vec2 uv) {
    const int width = int(image.extent.x), height = int(image.extent.y);
    const glm::vec2 texel = uv * glm::vec2(image.extent) - 0.5f;
    const glm::vec2 base = glm::floor(texel);
    const glm::vec2 weight = texel - base;
    const auto fetch = [&](int x, int y) {
        const float* rgb = image.pixel(unsigned((x + width) % width), unsigned(std::clamp(y, 0, height - 1)));
        return glm::vec3(rgb[0], rgb[1], rgb[2]);
    };
    const int x = int(base.x), y = int(base.y);
    return glm::mix(glm::mix(fetch(x, y), fetch(x + 1, y), weight.x),
                    glm::mix(fetch(x, y + 1), fetch(x + 1, y + 1), weight.x), weight.y);
}
}  // namespace

bool Environment::is_black() const {
    switch (type) {
        case Type::constant:
            return color == glm::vec3(0.0f);
        // The radiance is largest along +axis or -axis.
        case Type::gradient:
            return glm::max(color + glm::abs(slope), glm::vec3(0.0f)) == glm::vec3(0.0f);
        case Type::image:
            return std::ranges::all_of(latlong.values, [](float value) { return value == 0.0f; });
    }
    return true;
}

glm::vec3 Environment::radiance(glm::vec3 direction) const {
    switch (type) {
        case Type::constant:
            return color;
        case Type::gradient:
            return glm::max(color + slope * glm::dot(direction, axis), glm::vec3(0.0f));
        case Type::image:
            return bilinear(latlong, environment_uv(direction, rotation));
    }
    return glm::vec3(0.0f);
}
