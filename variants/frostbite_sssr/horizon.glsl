// The share of draws that go below the horizon.
#ifndef FROSTBITE_SSSR_HORIZON_GLSL
#define FROSTBITE_SSSR_HORIZON_GLSL
#include "core/shaders/gbuffer/lobe_table.glsl"

uniform sampler2D below_horizon;

// Share of the truncated lobe's draws that do.
float share_below_horizon(float mu_o, float roughness) { return read_lobe_table(below_horizon, mu_o, roughness).r; }

// 1 / density of a ray that was drawn again while it went below the horizon, over that of its lobe: draw n comes
// about with a probability of share^n, so that directions above the horizon have
// p (1 + share + ... + share^max_regenerations).
float redrawn_density_factor(float mu_o, float roughness) {
    if (max_regenerations == 0u) return 1.0;
    float share = share_below_horizon(mu_o, roughness);
    return (1.0 - share) / (1.0 - pow(share, float(max_regenerations + 1u)));
}
#endif
