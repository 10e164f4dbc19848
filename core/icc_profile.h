#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

/// A colour profile (ICC.1:2022) of an image.
struct IccProfile {
    std::string name;
    bool is_srgb = false;  ///< its codes are sRGB's, within half a code of 8 bits
    /// Codes in [0, 1] to linear Rec. 709, relative to the white; grey profiles take the first channel.
    std::function<void(std::span<glm::vec3>)> to_linear;
};

/// None if it cannot be read, or is a profile of neither RGB nor grey.
std::optional<IccProfile> read_icc_profile(std::span<const uint8_t> bytes);
