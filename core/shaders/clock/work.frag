#include "clock/work.glsl"
layout(location = 0) out vec4 result;
void main() { result = work(gl_FragCoord.xy); }
