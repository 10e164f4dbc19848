// Keeps the blocks of 2x2 pixels (smaller at the border of odd sizes) whose roughest pixel is smooth enough. As in the
// original, this reads the extracted roughness, which pixels outside the mask do not write.
#include "diligent_ssr/footprint.glsl"
uniform sampler2D depth, roughness;

void main() {
    ivec2 extent = ivec2(camera.extent.xy), first = 2 * ivec2(gl_FragCoord.xy), count = footprint(extent);
    float nearest = camera.depth.z, roughest = 0.0;
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x) {
            ivec2 pixel = min(first + ivec2(x, y), extent - 1);
            nearest = nearer_of(nearest, texelFetch(depth, pixel, 0).r);
            roughest = max(roughest, texelFetch(roughness, pixel, 0).r);
        }
    if (is_far_plane(nearest) || roughest > roughness_threshold) discard;
    gl_FragDepth = 1.0;  // as in mask.frag
}
