// The pixels that a texel of an image of half the size, rounded down, stands for.
#include "common/image_space.glsl"

// Columns and rows of a texel's footprint. Those that an odd size leaves over belong to the last texel; as in the
// original, every texel takes one more.
ivec2 footprint(ivec2 finer_extent) { return 2 + (finer_extent & 1); }
