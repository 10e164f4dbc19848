// Known amounts of all that is counted; images are smaller than the groups that cover them.
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source, filtered, mipped;
uniform writeonly image2D target;
struct Entry { vec4 color; uint count; };
layout(std430) buffer entries { Entry entry[]; };
layout(std430) buffer sums { uint sum; };
shared vec2 tile[8];

vec4 read(sampler2D image, ivec2 pixel) { return texelFetch(image, pixel, 0); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(target)))) return;
    vec4 total = vec4(0.0);
    for (int i = 0; i < pixel.x; ++i) total += read(source, pixel);
    total += read(filtered, pixel) + textureLod(filtered, vec2(0.5), 0.0) + textureGather(filtered, vec2(0.5));
    if (pixel.y > 0) total += textureLod(mipped, vec2(0.5), 0.5);
    Entry own = entry[0];
    total += own.color;
    if (pixel == ivec2(0)) {
        entry[1].count = 7u;
        tile[0] = vec2(1.0);
        total.xy += tile[0];
        atomicAdd(sum, 1u);
    }
    imageStore(target, pixel, total);
}
