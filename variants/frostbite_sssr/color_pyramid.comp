// One level of the colour pyramid: each texel is the mean of the finer image over the texel's area. With an odd number
// of rows or columns, a texel spans two of them and parts of a third.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D finer;
uniform writeonly image2D coarser;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), coarse = imageSize(coarser), fine = textureSize(finer, 0);
    if (any(greaterThanEqual(texel, coarse))) return;
    // In units of which a fine texel has `coarse` and a coarse texel `fine`.
    ivec2 begin = texel * fine, end = begin + fine;
    vec4 sum = vec4(0.0);
    for (int y = begin.y / coarse.y; y * coarse.y < end.y; ++y)
        for (int x = begin.x / coarse.x; x * coarse.x < end.x; ++x) {
            ivec2 from = ivec2(x, y) * coarse;
            ivec2 shared_part = min(from + coarse, end) - max(from, begin);
            float share = float(shared_part.x * shared_part.y) / float(fine.x * fine.y);
            sum += share * texelFetch(finer, ivec2(x, y), 0);
        }
    imageStore(coarser, texel, sum);
}
