#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

bool is_png(std::span<const uint8_t> bytes);

/// Width and height of a PNG, JPEG or WebP by its header, before it is decoded; (0, 0) of anything else.
glm::uvec2 encoded_extent(std::span<const uint8_t> bytes);
