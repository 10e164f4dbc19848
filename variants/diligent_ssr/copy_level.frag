#include "core/shaders/view.glsl"
uniform sampler2D copied;
layout(push_constant) uniform Source { int level, drops_background; };
layout(location = 0) out float copied_depth;

void main() {
    copied_depth = texelFetch(copied, ivec2(gl_FragCoord.xy), level).r;
    // The farthest surface of a background is not there.
    if (drops_background == 1 && is_background(copied_depth)) copied_depth = 1.0 - camera.depth.z;
}
