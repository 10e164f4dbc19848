#ifndef SHARED_DRAWN_LIGHT_H
#define SHARED_DRAWN_LIGHT_H
#include "core/shared/language.h"

/// A PunctualLight as shaders see it.
struct DrawnLight {
    vec4 intensity_type;   ///< rgb intensity; 0: directional, 1: point, 2: spot
    vec4 position_range;   ///< m
    vec4 direction_outer;  ///< unit, that in which light travels; cosine of the outer cone
    vec4 inner_cone;       ///< x: cosine of the inner cone
};
#endif
