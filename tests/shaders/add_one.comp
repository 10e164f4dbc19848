layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D previous_sum;
uniform writeonly image2D sum;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sum)))) return;
    imageStore(sum, pixel, texelFetch(previous_sum, pixel, 0) + 1.0);
}
