#ifndef SHARED_PUNCTUAL_LIGHT_H
#define SHARED_PUNCTUAL_LIGHT_H
#include "core/shared/language.h"

// KHR_lights_punctual, as its specification recommends.

/// Irradiance at normal incidence (W m^-2) of a point or spot light per radiant intensity (W sr^-1), at `distance` (m).
/// A range > 0 (m) fades it out smoothly; 0 is unlimited.
SHARED float punctual_falloff(float distance, float range) {
    float square = distance * distance;
    float window = 1.0f;
    if (range > 0.0f) {
        float x = distance / range;
        window = clamp(1.0f - x * x * x * x, 0.0f, 1.0f);
    }
    return window / square;
}

/// Part of a spot's intensity in a direction whose angle to its axis has the cosine `cosine`.
SHARED float spot_attenuation(float cosine, float inner_cone_cos, float outer_cone_cos) {
    float x = clamp((cosine - outer_cone_cos) / max(0.001f, inner_cone_cos - outer_cone_cos), 0.0f, 1.0f);
    return x * x;
}
#endif
