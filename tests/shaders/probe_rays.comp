// What variants/common/screen_probe/lookup.glsl says about rays, one per invocation.
#include "common/screen_probe/lookup.glsl"
layout(local_size_x = 64) in;

struct ProbeRay {
    vec4 from_camera, direction;  // world space
};
readonly buffer Rays { ProbeRay rays[]; };
writeonly buffer Surfaces { vec4 surfaces[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(rays.length())) return;
    surfaces[index] = surfaces_along(rays[index].from_camera.xyz, rays[index].direction.xyz);
}
