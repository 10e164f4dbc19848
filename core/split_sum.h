#pragma once
#include "core/host_image.h"

/// The split-sum factors of the specular lobe: its albedo is F0 * A + F90 * B, with
///   A = E[(1 - w) W], B = E[w W], w = (1 - o.m)^5, W = f mu_i / pdf without Fresnel, over visible normals
/// (Karis 2013, "Real Shading in Unreal Engine 4", for the height-correlated GGX lobe of core/shared/brdf.h).
/// mu_o: cosine of the viewer in (0, 1]. `alpha` is the GGX width, not clamped here. Error below 5e-5.
glm::dvec2 split_sum(double mu_o, double alpha);

/// Two channels A, B; column = mu_o, row = perceptual roughness, both at texel centres (i + 0.5) / size, for bilinear
/// reading clamped at the edges. With size 64 the error is below 1e-3, or 6e-3 for views within 6 degrees of grazing.
HostImage split_sum_table(unsigned size = 64);

/// The table of the default size, made once.
const HostImage& default_split_sum_table();

/// A, B from such a table. mu_o in (0, 1], perceptual roughness in [0, 1].
glm::vec2 read_split_sum(const HostImage& table, float mu_o, float roughness);
