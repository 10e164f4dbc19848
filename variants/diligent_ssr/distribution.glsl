// The GGX distribution of normals as the original computes it, from a cosine in single precision. Near the peak of
// smooth surfaces it is rounded, and floored, so that core/shared/brdf.h would weigh rays differently. Density and
// reuse of rays take this same function, so that the errors cancel.
#ifndef DILIGENT_SSR_DISTRIBUTION_GLSL
#define DILIGENT_SSR_DISTRIBUTION_GLSL
#include "core/shared/brdf.h"

// `cosine`: of micro-normal and normal, in [0, 1].
float floored_distribution(float cosine, float alpha) {
    float width = max(alpha, min_ggx_alpha), a2 = width * width;
    float t = cosine * cosine * a2 + (1.0 - cosine * cosine);
    float denominator = pi * t * t;
    return a2 / (distribution_floor ? max(denominator, 1e-9) : denominator);
}
#endif
