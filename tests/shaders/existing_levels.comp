// Finest levels of a depth pyramid that have a pixel.
#include "tracers/screen_cells.glsl"

layout(local_size_x = 64) in;
uniform sampler2D asked;  // pixel, coarsest level
uniform writeonly image2D existing;

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(asked, 0).x) return;
    ivec3 pixel_and_level = ivec3(texelFetch(asked, index, 0).xyz);
    imageStore(existing, index, vec4(existing_level(pixel_and_level.xy, pixel_and_level.z)));
}
