#pragma once
#include <glm/glm.hpp>
#include <string>

/// A size at two sizes of the screen, of which the second is twice the first on both sides.
struct SizeAtTwoScreens {
    glm::uvec2 screen, size, size_at_double;
};

/// How the size depends on the screen's W x H: "W x H", "W/2 x H/2 rounded up", "16 x 16"; "" if it is none of these.
/// Roundings are told apart only where a side of the smaller screen is not divisible.
std::string share_text(const SizeAtTwoScreens& size);

/// How a number of bytes depends on the pixels of the screen, in the same two sizes: "16", "4 * W * H".
std::string bytes_text(glm::uvec2 screen, size_t bytes, size_t bytes_at_double);
