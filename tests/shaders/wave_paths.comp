// Lanes that go different ways: loops within loops, a way out of both, a switch, an early return.
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source;
layout(rgba32f) uniform writeonly image2D target;

float walk(ivec2 pixel, int rounds) {
    float sum = 0.0;
    for (int round = 0; round < rounds; ++round) {
        for (int step = 0; step < (pixel.x + round) % 3; ++step) {
            if (((pixel.x + step) & 1) == 0) {
                sum += texelFetch(source, ivec2(step, round & 3), 0).x;
                if (sum > 3.5) return sum;
            } else {
                sum += texelFetch(source, ivec2(round & 3, step), 0).y;
                if (sum > 5.5) return sum;
            }
        }
        if (round == pixel.y) break;
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(target)))) return;
    float value = walk(pixel, pixel.x % 5);
    switch (pixel.y % 4) {
        case 0: value += texelFetch(source, pixel & 3, 0).y; break;
        case 2: value *= texelFetch(source, pixel & 1, 0).z; break;
        default: break;
    }
    imageStore(target, pixel, vec4(value));
}
