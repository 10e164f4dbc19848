#ifndef COMMON_LUMINANCE_GLSL
#define COMMON_LUMINANCE_GLSL

// Luminance of a linear colour with the primaries of ITU-R BT.709, which ssrlab's colours have.
float luminance_bt709(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

// Luma with the weights of gamma-encoded television (ITU-R BT.601), with which AMD's and DiligentFX's shaders weigh linear
// colours.
float luma_bt601(vec3 color) { return dot(color, vec3(0.299, 0.587, 0.114)); }
#endif
