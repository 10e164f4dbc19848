layout(location = 0) flat in uint instance;
layout(location = 0) out vec4 color;
uniform sampler2D tint;
void main() { color = vec4(float(instance), texelFetch(tint, ivec2(0), 0).g, 0.0, 1.0); }
