// The parameters `scale` and `offset`, of whichever set has them, in the first two channels.
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D shown;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    imageStore(shown, pixel, vec4(scale, offset, 0.0, 0.0));
}
