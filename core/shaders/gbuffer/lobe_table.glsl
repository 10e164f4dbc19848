// Tables by cosine of the viewer (columns) and perceptual roughness (rows); see core/shared/split_sum_tap.h.
#ifndef SHADERS_GBUFFER_LOBE_TABLE_GLSL
#define SHADERS_GBUFFER_LOBE_TABLE_GLSL
#include "core/shared/split_sum_tap.h"

// Between texels, clamped at the edges.
vec2 read_lobe_table(sampler2D table, float mu_o, float roughness) {
    SplitSumTap tap = split_sum_tap(mu_o, roughness, uint(textureSize(table, 0).x));
    vec2 low = mix(texelFetch(table, ivec2(tap.first), 0).rg,
                   texelFetch(table, ivec2(tap.last.x, tap.first.y), 0).rg, tap.fraction.x);
    vec2 high = mix(texelFetch(table, ivec2(tap.first.x, tap.last.y), 0).rg,
                    texelFetch(table, ivec2(tap.last), 0).rg, tap.fraction.x);
    return mix(low, high, tap.fraction.y);
}
#endif
