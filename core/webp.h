#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

/// Whether the bytes begin as a WebP does (RFC 9649, section 2.4).
bool is_webp(std::span<const uint8_t> file);

/// Width and height of a WebP by its header, before it is decoded; (0, 0) of anything else and of animations.
glm::uvec2 webp_extent(std::span<const uint8_t> file);

/// The codes of a WebP in memory as 8-bit RGBA with straight alpha, row by row. None if it is no intact still picture
/// or has another extent than the given one (pixels). Takes 16 bytes per pixel at most.
std::optional<std::vector<uint8_t>> decode_webp_rgba(std::span<const uint8_t> file, glm::uvec2 extent);
