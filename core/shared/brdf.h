#ifndef SHARED_BRDF_H
#define SHARED_BRDF_H
#include "core/shared/language.h"

// The glTF 2.0 metallic-roughness BRDF (Specification, Appendix B) in a local frame with the shading normal along +z:
//   f = (1 - metalness) [(1 - Fd) c / pi + Fd D V] + metalness Fm D V
// `alpha` is the GGX width, the square of the perceptual roughness that files and the G-buffer hold.
// o: towards the viewer, i: towards the light, both unit; mu_x: cosine of x to the normal.

const float pi = 3.14159265358979f;

/// Smaller widths are not told apart from a mirror by either renderer; see ggx_alpha().
const float min_ggx_alpha = 1e-3f;

SHARED float ggx_alpha(float perceptual_roughness) {
    return max(perceptual_roughness * perceptual_roughness, min_ggx_alpha);
}
#endif
