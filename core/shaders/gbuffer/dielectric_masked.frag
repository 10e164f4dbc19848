// Materials with alpha masks, in scenes where dielectrics reflect other than 0.04.
#define HAS_TEXTURES
#define HAS_MASK
#define HAS_DIELECTRIC_F0
#include "core/shaders/gbuffer/surface.glsl"
