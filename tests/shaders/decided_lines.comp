// Declarations and lines that a test decides.
#include "declarations"
layout(local_size_x = 8, local_size_y = 8) in;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
#include "lines"
}
