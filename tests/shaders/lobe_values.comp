// What variants/common/ggx_lobe.h and halton.h give on the device, eight numbers per input.
#include "common/ggx_lobe.h"
#include "common/halton.h"
layout(local_size_x = 64) in;

struct LobeInput {
    vec4 values;   // u, mu_o, perceptual roughness
    uvec4 choice;  // lobe, bias in 1/256, index, seed
};
readonly buffer Inputs { LobeInput inputs[]; };
writeonly buffer Values { float values[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(inputs.length())) return;
    LobeInput given = inputs[index];
    float alpha = ggx_alpha(given.values.w), mu_o = given.values.z;
    vec3 o = vec3(sqrt(1.0 - mu_o * mu_o), 0.0, mu_o);
    LobeSample drawn = sample_lobe(given.choice.x, o, alpha, float(given.choice.y) / 256.0, given.values.xy);
    vec2 point = rotated_halton(given.choice.z, given.choice.y & 3u, given.choice);
    float results[8] = float[](drawn.direction.x, drawn.direction.y, drawn.direction.z, drawn.inverse_density,
                               lobe_density(given.choice.x, o, drawn.direction, alpha), point.x, point.y, 0.0);
    for (uint k = 0u; k < 8u; ++k) values[index * 8u + k] = results[k];
}
