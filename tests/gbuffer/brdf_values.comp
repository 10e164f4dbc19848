// What the functions of core/shared/brdf.h give on the device, 16 numbers per input.
#include "core/shared/brdf.h"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Inputs { vec4 inputs[]; };  // u.x, u.y, mu_o, perceptual roughness
layout(std430) writeonly buffer Values { float values[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(inputs.length())) return;
    vec4 input_value = inputs[index];
    float alpha = ggx_alpha(input_value.w);
    vec3 o = vec3(sqrt(1.0 - input_value.z * input_value.z), 0.0, input_value.z);
    vec3 m = sample_ggx_normal(o, alpha, input_value.xy, 1.0);
    vec3 i = sample_ggx_reflection_bounded(o, alpha, input_value.xy);
    vec3 tangent = basis_from_normal(m)[0];
    float results[16] = float[](
        ggx_distribution(m, alpha) * alpha * alpha, smith_root(o.z, alpha), smith_visibility(o.z, input_value.x + 0.01, alpha), schlick_weight(o.z),
        m.x, m.y, m.z, i.x, i.y, i.z,
        ggx_reflection_weight(o.z, i.z, alpha), ggx_cap_bound(o.z, alpha), sample_cosine(input_value.xy).z,
        specular_f0(vec3(input_value.x), input_value.y, 0.5).x, specular_f90(input_value.y, 0.5), dot(tangent, vec3(1.0, 2.0, 3.0)));
    for (uint k = 0u; k < 16u; ++k) values[index * 16u + k] = results[k];
}
