#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

/// The codes of a JPEG in memory as 8-bit RGBA, row by row; alpha is 255. None if it is no intact JPEG, has another
/// extent than the given one (pixels), or is one that no RGB can be made of without a profile (CMYK). Takes 14 bytes
/// per pixel at most.
std::optional<std::vector<uint8_t>> decode_jpeg_rgba(std::span<const uint8_t> file, glm::uvec2 extent);
