#pragma once
#include "variants/passes/declaration.h"

inline constexpr int largest_side = 16384, most_mips = 15;  // of any device
inline constexpr int most_bytes = 1 << 28;

/// [width, height]; 0 without the key.
glm::uvec2 read_size(JsonObject& object, const std::string& key);
/// `divisor`, `round`, `margin`, `times` and `size`.
ScreenShare read_share(JsonObject& object);
/// Read one entry of `images`, or of `buffers`.
DeclaredImage read_image(JsonObject object, const KnownValues& known);
DeclaredBuffer read_buffer(JsonObject object, const KnownValues& known);
