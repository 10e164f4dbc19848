// One triangle corner of the scene, with the attributes that surface.glsl reads.
#include "core/shared/drawn_scene.h"

layout(std430) readonly buffer Vertices { float vertices[]; };
layout(std430) readonly buffer Instances { DrawnInstance instances[]; };

layout(location = 0) out vec3 ws_position;
layout(location = 1) out vec3 ws_normal;
layout(location = 2) out vec3 ws_tangent;
layout(location = 3) out vec4 uvs;
layout(location = 4) out vec4 color;
layout(location = 5) precise out vec4 clip_now;  // without jitter
layout(location = 6) precise out vec4 clip_before;
layout(location = 7) flat out vec3 ws_front_normal;
layout(location = 8) flat out uint material;
layout(location = 9) flat out float handedness;
layout(location = 10) flat out float common_alpha;  // of the triangle's vertex colours, -1: they differ

invariant gl_Position;

vec3 attribute3(uint offset) {
    uint base = uint(gl_VertexIndex) * vertex_stride + offset;
    return vec3(vertices[base], vertices[base + 1u], vertices[base + 2u]);
}
vec4 attribute4(uint offset) { return vec4(attribute3(offset), vertices[uint(gl_VertexIndex) * vertex_stride + offset + 3u]); }

void main() {
    DrawnInstance instance = instances[gl_InstanceIndex];
    vec4 os_position = vec4(attribute3(0u), 1.0);
    vec4 tangent = attribute4(6u);
    vec4 world = instance.world_from_object * os_position;

    ws_position = world.xyz;
    ws_normal = mat3(instance.normal_matrix) * attribute3(3u);
    ws_tangent = mat3(instance.world_from_object) * tangent.xyz;
    uvs = attribute4(10u);
    color = scene_has_vertex_colors ? attribute4(14u) : vec4(1.0);
    vec3 front = mat3(instance.normal_matrix) * attribute3(18u);
    float front_length = length(front);  // 0: a triangle without area, of which no fragment is drawn
    ws_front_normal = front_length > 0.0 ? front / front_length : vec3(0.0);
    common_alpha = vertices[uint(gl_VertexIndex) * vertex_stride + 21u];
    material = instance.ids.x;
    handedness = instance.ids.y == 1u ? -tangent.w : tangent.w;

    clip_now = camera.clip_from_world * world;
    clip_before = clip_now;
    if (!scene_is_still) {
        vec4 os_before = os_position;
        if (instance.ids.z != 0u) {
            uint at = instance.ids.z + 3u * uint(gl_VertexIndex);
            os_before.xyz = vec3(vertices[at], vertices[at + 1u], vertices[at + 2u]);
        }
        clip_before = camera.previous_clip_from_world * (instance.previous_world_from_object * os_before);
    }
    gl_Position = clip_now;
    // A sample lies at pixel centre + jitter, so the image moves the other way.
    gl_Position.xy -= 2.0 * camera.jitter.xy * camera.extent.zw * clip_now.w;
}
