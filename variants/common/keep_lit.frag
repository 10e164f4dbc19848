// Keeps the lit image for the next frame.
uniform sampler2D lit;
layout(location = 0) out vec4 kept_lit;

void main() { kept_lit = texelFetch(lit, ivec2(gl_FragCoord.xy), 0); }
