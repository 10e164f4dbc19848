// The surface behind the visible one: a second drawing leaves out all that is no farther (Everitt 2001, "Interactive
// Order-Independent Transparency"). HAS_MASK compiles in alpha masks. Backs that the scene hides are not drawn here,
// either: objects that end there count as sheets.
#include "core/shared/drawn_scene.h"

layout(std430) readonly buffer Materials { DrawnMaterial materials[]; };
layout(push_constant) uniform Peeling { float depth_step; };  // of the depth format; 0: exact
uniform sampler2D depth;

layout(location = 0) in vec3 ws_position;
layout(location = 3) in vec4 uvs;
layout(location = 4) in vec4 color;
layout(location = 7) flat in vec3 ws_front_normal;
layout(location = 8) flat in uint material;

layout(location = 0) out float second_depth;
layout(location = 1) out float back_depth;

#ifdef HAS_MASK
#include "core/shaders/gbuffer/textures.glsl"
#include "core/shaders/gbuffer/alpha_mask.glsl"
#endif

void main() {
    float visible = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    bool is_reversed = camera.depth.w == 1.0;
    if (is_reversed ? gl_FragCoord.z >= visible - depth_step : gl_FragCoord.z <= visible + depth_step) discard;
#ifdef HAS_MASK
    DrawnMaterial m = materials[material];
    if (is_cut_out(m, color.a, slot_value(base_color_texture, m, slot_base_color).a)) discard;
#endif
    vec3 to_camera = camera.frame.z == 1u ? camera.world_from_view[2].xyz : camera.world_from_view[3].xyz - ws_position;
    bool is_back = dot(ws_front_normal, to_camera) < 0.0;
    second_depth = gl_FragCoord.z;
    // Behind a front comes another front: what is visible has no inside, or ends where something else begins.
    back_depth = is_back ? gl_FragCoord.z : visible;
}
