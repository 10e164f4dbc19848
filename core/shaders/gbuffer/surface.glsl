// The surface of one fragment, as glTF 2.0, Appendix B, describes it. HAS_TEXTURES, HAS_MASK and
// HAS_DIELECTRIC_F0 compile in what the materials of the draw need.
#include "core/shaders/gbuffer/octahedral.glsl"
#include "core/shared/drawn_scene.h"

layout(push_constant) uniform Push { uint normal_bits; };

layout(std430) readonly buffer Materials { DrawnMaterial materials[]; };

layout(location = 0) in vec3 ws_position;
layout(location = 1) in vec3 ws_normal;
layout(location = 2) in vec3 ws_tangent;
layout(location = 3) in vec4 uvs;
layout(location = 4) in vec4 color;
layout(location = 5) in vec4 clip_now;
layout(location = 6) in vec4 clip_before;
layout(location = 7) flat in vec3 ws_front_normal;
layout(location = 8) flat in uint material;
layout(location = 9) flat in float handedness;

layout(location = 0) out vec4 geometric_normal;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 base_color;
layout(location = 3) out vec4 emission;
layout(location = 4) out vec2 motion;
layout(location = 5) out uint material_id;
#ifdef HAS_DIELECTRIC_F0
layout(location = 6) out vec4 dielectric_f0;
#endif

#ifdef HAS_TEXTURES
#include "core/shaders/gbuffer/textures.glsl"
#define SLOT(image, slot) slot_value(image, m, slot)
#ifdef HAS_DIELECTRIC_F0
uniform sampler2D specular_texture;
uniform sampler2D specular_color_texture;
#endif

#ifdef HAS_MASK
#include "core/shaders/gbuffer/alpha_mask.glsl"
#endif

vec3 mapped_normal(DrawnMaterial m, vec3 n) {
    vec3 local = (2.0 * SLOT(normal_texture, slot_normal).xyz - 1.0) * vec3(m.factors.zz, 1.0);
    float tangent_length = length(ws_tangent);
    if (!(tangent_length > 0.0)) return n;
    vec3 tangent = ws_tangent / tangent_length;
    vec3 mapped = local.x * tangent + local.y * handedness * cross(n, tangent) + local.z * n;
    float mapped_length = length(mapped);
    return mapped_length > 0.0 ? mapped / mapped_length : n;
}
#else
#define SLOT(image, slot) vec4(1.0)
#endif

void main() {
    DrawnMaterial m = materials[material];
    vec4 base_color_texel = SLOT(base_color_texture, slot_base_color);
    vec4 coloured = m.base_color * color * base_color_texel;
#ifdef HAS_MASK
    if (is_cut_out(m, color.a, base_color_texel.a)) discard;
#endif
    vec4 metalness_roughness = SLOT(metalness_roughness_texture, slot_metalness_roughness);
    bool is_unlit = m.flags.x == 1u;
    vec3 radiance = is_unlit ? coloured.rgb : m.emission.rgb * SLOT(emission_texture, slot_emission).rgb;

    float normal_length = length(ws_normal);
    vec3 n = normal_length > 0.0 ? ws_normal / normal_length : ws_front_normal;
#ifdef HAS_TEXTURES
    if (scene_has_normal_maps && (m.sampling[0][slot_normal] & sampling_has_texture) != 0u) n = mapped_normal(m, n);
#endif
    vec3 to_camera = camera.frame.z == 1u ? camera.world_from_view[2].xyz : camera.world_from_view[3].xyz - ws_position;
    bool is_behind = dot(ws_front_normal, to_camera) < 0.0;
    float side = is_behind ? -1.0 : 1.0;
    if (is_behind && m.flags.y == 0u) radiance = vec3(0.0);  // single-sided emitters shine forward only

    geometric_normal = vec4(side * ws_front_normal, 0.0);
    n *= side;
    if (normal_bits > 0u) n = octahedral(n, normal_bits);
    normal = vec4(n, m.factors.y * metalness_roughness.g);
    base_color = is_unlit ? vec4(0.0) : vec4(coloured.rgb, m.factors.x * metalness_roughness.b);
    emission = vec4(radiance, is_unlit ? 0.0 : m.emission.w);
#ifdef HAS_DIELECTRIC_F0
    emission.w *= SLOT(specular_texture, slot_specular).a;
    dielectric_f0 = vec4(min(m.specular_color.rgb * SLOT(specular_color_texture, slot_specular_color).rgb, vec3(1.0)), 0.0);
#endif
    precise vec2 now = clip_now.xy / clip_now.w, before = clip_before.xy / clip_before.w;  // of what is still: equal
    motion = scene_is_still ? vec2(0.0) : 0.5 * (now - before);
    material_id = material + 1u;
}
