// What a pixel reflects where the technique finds nothing: the environment over its lobe, taken as round about the mirror
// direction.
#include "core/shaders/gbuffer/environment.glsl"
#include "core/shaders/gbuffer/pixel.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D depth;
uniform sampler2D normal;
layout(rgba32f) uniform writeonly image2D fallback;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(fallback)))) return;
    vec3 mean = vec3(0.0);
    if (!is_background(texelFetch(depth, pixel, 0).r)) {
        vec4 normal_roughness = texelFetch(normal, pixel, 0);
        mean = mean_over_lobe(reflect(ws_pixel_direction(pixel), normal_roughness.xyz), normal_roughness.w);
    }
    imageStore(fallback, pixel, vec4(mean, 0.0));
}
