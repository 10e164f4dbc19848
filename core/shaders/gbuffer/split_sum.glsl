// The split-sum factors of core/split_sum.h from the image of core/gbuffer/split_sum_image.h.
#include "core/shaders/gbuffer/lobe_table.glsl"

uniform sampler2D split_sum;

// A, B of the specular lobe's albedo F0 A + F90 B.
vec2 split_sum_factors(float mu_o, float roughness) { return read_lobe_table(split_sum, mu_o, roughness); }
