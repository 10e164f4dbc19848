#define HAS_MASK
#include "core/shaders/gbuffer/peel.glsl"
