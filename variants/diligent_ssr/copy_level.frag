uniform sampler2D copied;
layout(push_constant) uniform Source { int level; };
layout(location = 0) out float copied_depth;

void main() { copied_depth = texelFetch(copied, ivec2(gl_FragCoord.xy), level).r; }
