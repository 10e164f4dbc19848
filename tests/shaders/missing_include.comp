// Names a file that there is not.
#include "no_such_part.glsl"
layout(local_size_x = 1) in;
void main() {}
