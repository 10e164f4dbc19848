// Discards below the first rows, in a function and after a fetch.
layout(location = 0) out vec4 color;
uniform sampler2D source;
vec4 kept(vec4 value) {
    if (gl_FragCoord.y > 5.0) discard;
    return value;
}
void main() { color = kept(texelFetch(source, ivec2(0), 0)) + texelFetch(source, ivec2(1), 0); }
