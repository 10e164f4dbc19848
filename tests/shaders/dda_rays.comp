// Marches the test's own rays through the depth image; found: place on the screen (pixels), distance (m), 1 if it hit.
#include "mcguire_dda/dda.glsl"

layout(local_size_x = 64) in;
uniform sampler2D ray_origin, ray_direction;
uniform writeonly image2D found;

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(ray_origin, 0).x) return;
    DdaHit hit = march(Ray(texelFetch(ray_origin, index, 0).xyz, texelFetch(ray_direction, index, 0).xyz), jitter);
    imageStore(found, index, vec4(hit.position, hit.distance, hit.is_hit ? 1.0 : 0.0));
}
