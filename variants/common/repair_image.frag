// Copies one image of the G-buffer and repairs values that are not finite, depths outside [0, 1] and directions that
// are not unit.
#include "core/shaders/view.glsl"

uniform sampler2D given, surface_depth;
layout(push_constant) uniform Push { uint kind; };
layout(location = 0) out vec4 repaired;

const uint kind_depth = 1u, kind_direction = 2u;  // repaired_inputs.cpp; else values

bool is_sound(float value) { return !isnan(value) && !isinf(value); }
bool is_sound(vec4 value) { return is_sound(value.x) && is_sound(value.y) && is_sound(value.z) && is_sound(value.w); }

vec3 towards_viewer() { return camera.world_from_view[2].xyz; }

// Where `length` is not 1, though a product of halves and of bytes says so.
const float unit_tolerance = 0.002;

// xyz a direction, w perceptual roughness: of what is no roughness a surface without reflection. The background has no
// direction, which is 0.
vec4 repaired_direction(vec4 value, bool is_surface) {
    if (!is_surface) return is_sound(value) ? value : vec4(0.0);
    float squared = dot(value.xyz, value.xyz);
    if (!is_sound(squared) || squared < 1e-12)
        value.xyz = towards_viewer();
    else if (abs(squared - 1.0) > unit_tolerance)
        value.xyz = normalize(value.xyz);
    if (!is_sound(value.w)) value.w = 1.0;
    return value;
}

void main() {
    vec4 value = texelFetch(given, ivec2(gl_FragCoord.xy), 0);
    if (kind == kind_depth)
        repaired = value.r >= 0.0 && value.r <= 1.0 ? value : camera.depth.zzzz;
    else if (kind == kind_direction)
        repaired = repaired_direction(value, !is_background(texelFetch(surface_depth, ivec2(gl_FragCoord.xy), 0).r));
    else
        repaired = is_sound(value) ? value : vec4(0.0);
}
