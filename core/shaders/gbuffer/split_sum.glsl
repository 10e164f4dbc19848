// The split-sum factors of core/split_sum.h from the image of core/gbuffer/split_sum_image.h.
#include "core/shared/split_sum_tap.h"

uniform sampler2D split_sum;

// A, B of the specular lobe's albedo F0 A + F90 B.
vec2 split_sum_factors(float mu_o, float roughness) {
    SplitSumTap tap = split_sum_tap(mu_o, roughness, uint(textureSize(split_sum, 0).x));
    vec2 low = mix(texelFetch(split_sum, ivec2(tap.first), 0).rg,
                   texelFetch(split_sum, ivec2(tap.last.x, tap.first.y), 0).rg, tap.fraction.x);
    vec2 high = mix(texelFetch(split_sum, ivec2(tap.first.x, tap.last.y), 0).rg,
                    texelFetch(split_sum, ivec2(tap.last), 0).rg, tap.fraction.x);
    return mix(low, high, tap.fraction.y);
}
