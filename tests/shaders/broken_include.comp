#include "broken_part.glsl"
layout(local_size_x = 1) in;
void main() {}
