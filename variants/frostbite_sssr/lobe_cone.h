#ifndef FROSTBITE_SSSR_LOBE_CONE_H
#define FROSTBITE_SSSR_LOBE_CONE_H
#include "core/shared/language.h"

// The cone that holds half of a truncated lobe (variants/common/ggx_lobe.h).

/// Tangent of its half angle, seen along the normal, where both lobes are the same: half of the normals that are left
/// have tan^2 < alpha^2 u / (1 - u) with u = (1 - bias) / 2 (Walter et al. 2007, eq. 35), and a mirror that turns by an
/// angle turns what it shows by twice as much. `bias` in [0, 1).
SHARED float lobe_cone_tangent(float alpha, float bias) {
    float tangent = alpha * sqrt((1.0f - bias) / (1.0f + bias));
    return 2.0f * tangent / max(1.0f - tangent * tangent, 1e-3f);
}

/// The same over that seen along the normal, for a cosine mu_o of the view: normals that turn across the plane of view
/// turn what they show by mu_o times as much only. Fitted to narrow lobes within 4 % (ours).
SHARED float lobe_cone_narrowing(float mu_o) { return sqrt((1.0f + 2.0f * mu_o * mu_o) / 3.0f); }
#endif
