#pragma once
#include "core/scene/scene.h"

/// The texel-filtered value of a texture at uv (0, 0 is the corner of the first texel): bilinear on level 0, or
/// nearest, with colours decoded from sRGB before filtering. RGBA in [0, 1], linear.
glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

/// Prefetches the texels that sample_texture() will read.
void prefetch_texture(const Texture& texture, glm::vec2 uv);
