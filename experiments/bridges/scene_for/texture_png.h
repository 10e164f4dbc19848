#pragma once
#include "core/scene/scene.h"

#include <cstddef>
#include <vector>

/// The unchanged texels as the bytes of a PNG: RGB if all alpha is 255, else RGBA.
std::vector<std::byte> texture_png(const Texture& texture);
