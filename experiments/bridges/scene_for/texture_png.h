#pragma once
#include "core/scene/scene.h"

#include <cstddef>
#include <vector>

/// The texels as they are, as the bytes of a PNG: RGB where all alpha is 255, else RGBA.
std::vector<std::byte> texture_png(const Texture& texture);
