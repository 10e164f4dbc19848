// What a pixel keeps from frame to frame.
#ifndef RATIO_ACCUMULATION_STATE_GLSL
#define RATIO_ACCUMULATION_STATE_GLSL
#include "common/ggx_lobe.h"
#include "common/luminance.glsl"
#include "denoisers/ray.glsl"

// What a pixel is to the rays that it weighs; view space but for the normal.
struct Receiver {
    vec3 position, ws_normal;
    mat3 view_from_local;
    vec3 o;  // towards the viewer, local
    float roughness, alpha;
};

Receiver receiver_at(ivec2 pixel, float device_depth, vec4 normal_roughness) {
    Receiver receiver;
    receiver.position = view_position_at(pixel, device_depth);
    receiver.ws_normal = normal_roughness.xyz;
    receiver.view_from_local = basis_from_normal(view_from_world_normal(receiver.ws_normal));
    receiver.o = -view_direction(receiver.position) * receiver.view_from_local;
    receiver.roughness = normal_roughness.w;
    receiver.alpha = ggx_alpha(receiver.roughness);
    return receiver;
}

// In images: `accumulated`, the colour of what is known and the share of it that is known; `moments`; `reflected_length`.
struct State {
    vec4 shown;  // colour times that share, that share
    // x: weight, the sum of ratios, 0 where no ray counts. Of the compressed luminance of what is known: y mean over few
    // frames, z over as many as `shown`, w variance of a frame about the first.
    vec4 moments;
    float ray_length;  // mean of rays that hit (m), 0: none did
};

const State no_state = State(vec4(0.0), vec4(0.0), 0.0);

vec4 shown_color(vec4 known) { return vec4(known.rgb * known.a, known.a); }
vec4 known_color(vec4 shown) {
    const float least_share = 1e-6;  // below which the quotient says nothing
    return shown.a > least_share ? vec4(shown.rgb / shown.a, min(shown.a, 1.0)) : vec4(0.0);
}

// In which one bright ray decides little.
float compressed_luminance(vec4 shown) {
    float luminance = luminance_bt709(known_color(shown).rgb);
    return luminance / (1.0 + luminance);
}
#endif
