// Materials with alpha masks; the discard takes the early depth test away.
#define HAS_TEXTURES
#define HAS_MASK
#include "core/shaders/gbuffer/surface.glsl"
