#include "core/shaders/gbuffer/peel.glsl"
