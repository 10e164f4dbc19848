// The depth buffer, as its format rounded it, in an image that every pass can read.
uniform sampler2D depth_buffer;
layout(location = 0) out float depth;

void main() { depth = texelFetch(depth_buffer, ivec2(gl_FragCoord.xy), 0).r; }
