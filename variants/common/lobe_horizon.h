#pragma once

/// Share of the draws of sample_lobe() (variants/common/ggx_lobe.h) that go below the horizon, of the truncated lobe.
/// `lobe`: lobe_of_normals or lobe_of_visible_normals; `mu_o`: cosine of the viewer, in (0, 1]; `alpha`: GGX width,
/// above 0; `bias`: share of the lobe that is cut off, in [0, 1). In [0, 1), by quadrature, with an error below 1e-3.
double share_below_horizon(unsigned lobe, double mu_o, double alpha, double bias);
