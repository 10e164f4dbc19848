// Materials with textures, without alpha masks.
#define HAS_TEXTURES
#include "core/shaders/gbuffer/surface.glsl"
