// The lit colour at the hit stands for the mirrored radiance.
#include "common/mirror_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D hit, lit;
uniform writeonly image2D radiance, confidence;

vec3 lit_at(vec2 uv) {
    if (bilinear_color) return textureLod(lit, uv - camera.jitter.xy * camera.extent.zw, 0.0).rgb;
    return texelFetch(lit, pixel_from_screen(uv * camera.extent.xy), 0).rgb;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 found = texelFetch(hit, pixel, 0);
    imageStore(radiance, pixel, vec4(found.w > 0.0 ? lit_at(found.xy) : vec3(0.0), 1.0));
    imageStore(confidence, pixel, vec4(found.w));
}
