// Reads the middle of the four corner texels with the bound sampler.
layout(local_size_x = 1) in;
uniform sampler2D source;
uniform writeonly image2D target;
void main() { imageStore(target, ivec2(0), textureLod(source, vec2(0.5), 0.0)); }
