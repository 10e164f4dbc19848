// The depth of surfaces alone, for the farthest ones: background becomes the near plane.
#include "core/shaders/view.glsl"
uniform sampler2D copied;
layout(location = 0) out float copied_depth;

void main() {
    copied_depth = texelFetch(copied, ivec2(gl_FragCoord.xy), 0).r;
    if (is_background(copied_depth)) copied_depth = 1.0 - camera.depth.z;
}
