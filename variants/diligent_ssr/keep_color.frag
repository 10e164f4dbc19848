uniform sampler2D lit;
layout(location = 0) out vec4 hit_color;

void main() { hit_color = texelFetch(lit, ivec2(gl_FragCoord.xy), 0); }
