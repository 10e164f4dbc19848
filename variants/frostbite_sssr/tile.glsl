// Tiles of the classification, and their blocks of pixels with one probe each.
#ifndef FROSTBITE_SSSR_TILE_GLSL
#define FROSTBITE_SSSR_TILE_GLSL

const int tile_width = 32, block_width = 8, blocks_per_tile = tile_width / block_width;

// Texels of `probes`: compressed luminance and one of these.
const float no_probe = 0.0, probe_missed = 1.0, probe_hit = 2.0;
#endif
