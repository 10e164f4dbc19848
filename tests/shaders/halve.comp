// One level of a pyramid: the sum of two texels of the finer one, plus 1.
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D finer;
uniform writeonly image2D coarser;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(coarser)))) return;
    float a = texelFetch(finer, 2 * pixel, 0).r, b = texelFetch(finer, 2 * pixel + ivec2(1, 0), 0).r;
    imageStore(coarser, pixel, vec4(a + b + 1.0));
}
