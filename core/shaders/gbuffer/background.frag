// What every pixel holds where nothing is drawn: no surface, and the motion of the sky at infinity.
#include "core/shaders/view.glsl"

layout(location = 0) out vec4 geometric_normal;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 base_color;
layout(location = 3) out vec4 emission;
layout(location = 4) out vec2 motion;
layout(location = 5) out uint material_id;

// uv now - uv before of a point infinitely far away. All rays of an orthographic camera meet the same one: it has no place.
vec2 sky_motion() {
    if (scene_is_still || camera.frame.z == 1u || camera.previous_clip_from_world == camera.clip_from_world) return vec2(0.0);
    vec2 uv = (gl_FragCoord.xy + camera.jitter.xy) * camera.extent.zw;
    vec4 vs_far = camera.view_from_clip * vec4(uv * 2.0 - 1.0, 0.5, 1.0);
    vec3 ws_direction = mat3(camera.world_from_view) * (vs_far.xyz / vs_far.w);
    vec4 clip_before = camera.previous_clip_from_world * vec4(ws_direction, 0.0);
    if (clip_before.w <= 0.0) return vec2(0.0);  // it was behind the camera
    return uv - (clip_before.xy / clip_before.w * 0.5 + 0.5);
}

void main() {
    geometric_normal = vec4(0.0);
    normal = vec4(0.0, 0.0, 0.0, 1.0);
    base_color = vec4(0.0);
    emission = vec4(0.0);
    motion = sky_motion();
    material_id = 0u;
}
