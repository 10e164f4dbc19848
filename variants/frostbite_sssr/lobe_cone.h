#ifndef FROSTBITE_SSSR_LOBE_CONE_H
#define FROSTBITE_SSSR_LOBE_CONE_H
#include "core/shared/language.h"

// The cone that holds half of a truncated lobe (variants/common/ggx_lobe.h).

/// Tangent of the cone's half angle, seen along the normal, where both lobes are the same. Half of the remaining
/// normals have tan^2 < alpha^2 u / (1 - u) with u = (1 - bias) / 2 (Walter et al. 2007, eq. 35). A mirror that turns
/// by an angle turns its reflection by twice that angle. `bias` in [0, 1).
SHARED float lobe_cone_tangent(float alpha, float bias) {
    float tangent = alpha * sqrt((1.0f - bias) / (1.0f + bias));
    return 2.0f * tangent / max(1.0f - tangent * tangent, 1e-3f);
}

/// lobe_cone_tangent() for a cosine mu_o of the view, over its value along the normal. Normals that turn across the
/// plane of view turn their reflection by mu_o times as much only. ssrlab's fit for narrow lobes, within 4 %.
SHARED float lobe_cone_narrowing(float mu_o) { return sqrt((1.0f + 2.0f * mu_o * mu_o) / 3.0f); }
#endif
