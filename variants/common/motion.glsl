// How far a pixel's surface has moved since the previous frame.
#ifndef COMMON_MOTION_GLSL
#define COMMON_MOTION_GLSL
uniform sampler2D motion;

// The uv now minus the uv before, both without jitter.
vec2 motion_at(ivec2 pixel) { return scene_is_still ? vec2(0.0) : texelFetch(motion, pixel, 0).xy; }
#endif
