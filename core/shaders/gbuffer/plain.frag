// Materials without textures or alpha masks.
#include "core/shaders/gbuffer/surface.glsl"
