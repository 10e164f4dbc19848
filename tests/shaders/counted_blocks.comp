// Reads 1 KiB in each turn of a loop, of which it needs four bytes.
layout(local_size_x = 8, local_size_y = 8) in;
struct Block { float values[256]; };
layout(std430) buffer blocks { Block block[]; };
uniform writeonly image2D target;
void main() {
    float sum = 0.0;
    for (int i = 0; i < 1100; ++i) {
        Block read = block[i & 1];
        sum += read.values[3];
    }
    imageStore(target, ivec2(gl_GlobalInvocationID.xy), vec4(sum));
}
