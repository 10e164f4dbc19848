#pragma once
#include <glm/glm.hpp>
#include <string>

/// A number of pixels, or bytes, on two screens. Only if the second screen has odd sides are all roundings told apart.
template <class Size>
struct SizeOnTwoScreens {
    glm::uvec2 screen;
    Size size;
    glm::uvec2 other_screen;
    Size other_size;
};

/// How the size depends on the screen's W x H: "W x H", "W/2 x H/2 rounded up", "16 x 16"; "" if it is none of these.
std::string share_text(const SizeOnTwoScreens<glm::uvec2>& size);

/// How a number of bytes depends on the screen: "16", "16 * ceil(W/2) * ceil(H/2)"; else "about 4.2 * W * H".
std::string bytes_text(const SizeOnTwoScreens<size_t>& bytes);
