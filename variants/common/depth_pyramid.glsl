// The depth pyramid, and how many levels it has (depth_pyramid.h).
#ifndef COMMON_DEPTH_PYRAMID_GLSL
#define COMMON_DEPTH_PYRAMID_GLSL

uniform sampler2D depth_pyramid;  // nearest depths

// The coarsest level of a pyramid of `mips` levels at most. GLSL ES 3.00 cannot ask the image.
int depth_pyramid_coarsest(uint mips) {
    int extent = int(max(camera.extent.x, camera.extent.y)), level = 0;
    while (level + 1 < int(mips) && extent >> (level + 1) > 0) ++level;
    return level;
}
#endif
